// The command lines of `xr3 exec` and `xr3 grade`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/cli_fwd.hpp"
#include "core/units.hpp"
#include "protocol/goals/vary.hpp"

namespace xr3 {

struct ServeOptions;

/// Maximum of --jobs.
inline constexpr int kMaxJobs = 256;

/// What the program under test may do on the monitor port.
enum class MonitorAccess : std::uint8_t {
  kNone,  ///< there is none
  kRead,
  kControl,  ///< it could move blocks by itself
};

/// Limits of a run; 0: none.
struct RunLimits {
  Tick sim_ticks = 600 * kTickHz;
  double wall_s = 60;
  std::uint64_t bytes = 0;       ///< that the program sends
  std::size_t memory_mib = 512;  ///< of all its processes, and of its files in the sandbox
  std::size_t processes = 64;    ///< that it may have at a time
};

struct ExecOptions {
  std::string exercise;  ///< a name, folder or archive that says the robot and goals; empty: none
  std::string goals;     ///< a file; empty: none
  RunLimits limits;
  MonitorAccess monitor = MonitorAccess::kNone;
  bool has_input = false;  ///< the program reads standard input
  bool is_quiet = false;   ///< its output is not shown
  bool is_sandboxed = false;
  std::string run_as;                 ///< name or number of a user; empty: see program_user()
  std::string without_sandbox;        ///< how to go without it, for messages
  std::vector<std::string> readable;  ///< in the sandbox, beside the files of the command
  int repeat = 1;
  std::optional<Variation> vary;
  std::string csv;    ///< a table of joints over time; empty: none
  std::string junit;  ///< files for the results; empty: none
  std::string json;
  std::string markdown;
  std::string out;  ///< a new folder for the files of each run; empty: none
  std::vector<std::string> command;
};

struct GradeOptions {
  std::string folder;             ///< with the submissions
  std::string report;             ///< a new folder for the report
  bool has_only_missing = false;  ///< the folder may have results already, which are kept
  std::size_t jobs = 0;           ///< submissions at a time; 0: the usual number
};

/// The subcommands; `server` is for the robot. The command of `grade` has `{}` for the submission.
void add_exec(CLI::App& app, ExecOptions& options, ServeOptions& server);
void add_grade(CLI::App& app, GradeOptions& options, ExecOptions& exec, ServeOptions& server);

/// `SEED`, `SEED:MM` or `SEED:MM,DEG`. Throws std::invalid_argument, with the allowed form.
Variation parse_variation(const std::string& text);

}  // namespace xr3
