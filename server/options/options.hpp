// The options of `xr3 serve` as values.
//
// The flow through the folder: the command line (cli/options/serve.cpp) fills a ServeOptions from
// arguments, environment variables and a config file, and checks that the options are consistent;
// other commands fill the members that they share with `serve`, such as `exec` for the robot of its
// run. For each value that is not an argument, option_sources.hpp keeps the variable or the line of
// the file it is from, and with_option_source() puts that in front of the message if a file of the
// option cannot be used. cells.hpp derives the cells to open: one named main, `--cells N` with
// consecutive ports, or one for each `--cell NAME=ROBOT,WORKCELL,PORT` and row of a roster, which
// roster.hpp reads; it throws a CellPlanError if they contradict each other. cell_tokens.hpp gives
// each its token, and keeps it beside the roster. App (server/app.hpp) takes options and plans and
// opens everything. Values are plain: durations are in seconds or ticks as their names say, and an
// empty text or 0 often stands for an option that was not given, as noted at each member.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/byte_clock.hpp"
#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/serial_settings.hpp"
#include "server/base/option_sources.hpp"
#include "server/options/cells.hpp"
#include "server/options/token.hpp"

namespace xr3 {

/// The initial clock: real, at a rate; manual, advanced only by the monitor; or advanced by the
/// bytes of the lines.
struct ClockChoice {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  ByteClockSettings bytes;  ///< has_concurrent_lines is a separate option
  bool operator==(const ClockChoice&) const = default;
};

/// The serial port of a physical controller.
struct DeviceChoice {
  std::string path;
  SerialSettings settings;
};

/// The robot of commands that name none.
inline constexpr const char* kUsualRobot = "rhino-xr3";

/// The longest past that a cell keeps.
inline constexpr Tick kMaxHistory = Tick{24} * 3600 * kTickHz;

/// The connections for which each of several cells has room, unless --max-lines says otherwise.
inline constexpr std::size_t kLinesOfEachCell = 4;

struct ServeOptions {
  std::string robot = kUsualRobot;    ///< name or path
  std::string workcell;               ///< empty for the one with the robot's name
  std::string listen = "localhost";   ///< localhost: 127.0.0.1 and, with IPv6, ::1
  std::uint16_t robot_port = 9600;    ///< 0 for any free port
  std::uint16_t monitor_port = 9601;  ///< 0 for any free port
  std::string exercise;               ///< name or path; empty for none
  std::string goals;                  ///< file of the goals that the overview shows; empty for none
  std::string exercise_title;         ///< title for these goals; empty if there is none
  std::size_t cells = 0;              ///< 0 for one, with the name main
  std::vector<CellChoice> cell_choices;  ///< those of --cell and of the roster
  std::string roster;                    ///< file with the roster; empty for none
  bool is_cell_per_connection = false;
  std::size_t max_cells = 1000;
  /// Time for which a cell or the owner of its port is kept after its last line.
  double linger_s = 60;
  bool binds_peer = false;
  Profile profile = Profile::kPaper;
  ClockChoice clock;
  bool has_concurrent_lines = false;  ///< byte clock: execute the bytes of all lines as they arrive
  std::size_t max_lines = 64;
  Guard guard = Guard::kNormal;
  std::string fault_file;               ///< name or path; empty if there is none
  std::optional<LineSpeed> line_speed;  ///< nullopt if bytes take no time
  std::optional<DeviceChoice> device;
  bool is_mirrored = false;         ///< the simulation imitates the device
  std::vector<std::string> ptys;    ///< paths of pseudo-terminals
  std::uint32_t pty_mode = 0600;    ///< rights of their slaves
  std::size_t max_per_address = 0;  ///< 0 for the default
  std::size_t max_memory_mib = 512;
  std::string port_file;  ///< empty for none
  std::string record;     ///< file of the recording; empty for none
  std::size_t record_max_mib = 1024;
  std::size_t record_total_mib = 8192;
  int record_keep_days = 0;             ///< age at which recordings are deleted; 0 for never
  bool is_continued = false;            ///< cells go on from the end of their recordings
  Tick history_ticks = 3600 * kTickHz;  ///< duration for which the past is kept; 0 for no past
  std::string log_level = "info";
  std::string log_file;  ///< empty for standard error
  TokenSource token;
  bool is_private = false;
  std::string metrics_token_file;  ///< empty for none
  std::vector<std::string> allow_hosts;
  std::vector<std::string> allow_origins;
  std::vector<std::string> allow_frames;  ///< origins
  bool is_insecure = false;
  bool is_until_stdin_ends = false;
  std::string config;  ///< a config file; empty for none
  OptionSources option_sources;
};

/// Whether there are, or may be, several cells.
inline bool has_many_cells(const ServeOptions& options) {
  return options.cells > 0 || !options.cell_choices.empty() || options.is_cell_per_connection;
}

/// Whether an address is 127.0.0.0/8, ::1 or localhost: reachable from this machine only.
bool is_loopback(const std::string& address);

}  // namespace xr3
