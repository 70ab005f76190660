// The command lines of `xr3 exec` and `xr3 grade`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/judge/sim_limit.hpp"
#include "cli/options/cli_fwd.hpp"
#include "core/units.hpp"
#include "protocol/goals/vary.hpp"

namespace xr3 {

struct ServeOptions;

/// Maximum of --jobs.
inline constexpr int kMaxJobs = 256;

/// The program's rights on the monitor port.
enum class MonitorAccess : std::uint8_t {
  kNone,  ///< no monitor port
  kRead,
  kControl,  ///< the program can move blocks by itself
};

/// Limits of a run; 0 for none.
struct RunLimits {
  Tick sim_ticks = kUsualSimLimit;
  double wall_s = 60;
  std::uint64_t bytes = 0;       ///< number sent by the program
  std::size_t memory_mib = 512;  ///< memory of all its processes, and of its files in the sandbox
  std::size_t processes = 64;    ///< maximum number at a time
};

struct ExecOptions {
  /// A name, folder or archive with the robot and goals; empty if there is none.
  std::string exercise;
  std::string goals;  ///< a file; empty if there is none
  RunLimits limits;
  MonitorAccess monitor = MonitorAccess::kNone;
  bool has_input = false;  ///< whether the program reads standard input
  bool is_quiet = false;   ///< whether its output is hidden
  bool is_sandboxed = false;
  std::string run_as;           ///< name or number of a user; empty for program_user()
  std::string without_sandbox;  ///< the way to do without it, for messages
  /// Paths readable in the sandbox, beside the files of the command.
  std::vector<std::string> readable;
  int repeat = 1;
  std::optional<Variation> vary;
  std::string csv;    ///< a table of joints over time; empty for none
  std::string junit;  ///< a file for the results; empty for none, as for the next three
  std::string json;
  std::string markdown;
  std::string github;
  std::string out;  ///< a new folder for the files of each run; empty for none
  std::vector<std::string> command;
};

struct GradeOptions {
  std::string folder;  ///< folder with the submissions
  std::string report;  ///< a new folder for the report
  std::string main;    ///< the file that is run of a folder; empty for the folder
  bool has_only_missing = false;  ///< whether the folder may have results, which are continued
  std::size_t jobs = 0;  ///< submissions at a time; 0 for the default
};

/// Adds the subcommands; `server` is for the robot. The command of `grade` has `{}` for the
/// submission.
void add_exec(CLI::App& app, ExecOptions& options, ServeOptions& server);
void add_grade(CLI::App& app, GradeOptions& options, ExecOptions& exec, ServeOptions& server);

}  // namespace xr3
