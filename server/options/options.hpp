// The parsed command line as values, or the error in it. No side effects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cell/byte_clock.hpp"
#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/serial_settings.hpp"
#include "server/exit_code.hpp"
#include "server/monitor_port/token.hpp"
#include "server/options/cells.hpp"
#include "server/options/exec.hpp"
#include "server/options/healthcheck.hpp"
#include "server/options/manual.hpp"
#include "server/options/option_sources.hpp"
#include "server/options/replay.hpp"
#include "server/options/term.hpp"
#include "server/options/watch.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/kin/question.hpp"

namespace xr3 {

/// The initial clock: real, at a rate, or manual, advanced only by the monitor, or that of the
/// bytes.
struct ClockChoice {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  ByteClockSettings bytes;  ///< has_concurrent_lines is an option of its own
  bool operator==(const ClockChoice&) const = default;
};

/// The serial port of a physical controller.
struct DeviceChoice {
  std::string path;
  SerialSettings settings;
};

struct ServeOptions {
  std::string robot = "rhino-xr3";    ///< name or path
  std::string workcell;               ///< name or path; empty: the one with the robot's name
  std::string listen = "localhost";   ///< localhost: 127.0.0.1 and, with IPv6, ::1
  std::uint16_t robot_port = 9600;    ///< 0: any free port
  std::uint16_t monitor_port = 9601;  ///< 0: any free port
  std::size_t cells = 0;              ///< 0: one, with the name main
  std::vector<CellChoice> cell_choices;
  bool is_cell_per_connection = false;
  std::size_t max_cells = 1000;
  double linger_s = 60;  ///< how long a cell or the owner of its port is kept after its last line
  bool binds_peer = false;
  Profile profile = Profile::kPaper;
  ClockChoice clock;
  bool has_concurrent_lines = false;  ///< with the byte clock: all lines are obeyed together
  std::size_t max_lines = 1024;
  Guard guard = Guard::kNormal;
  std::string fault_file;               ///< name or path; empty: none
  std::optional<LineSpeed> line_speed;  ///< nullopt: bytes take no time
  std::optional<DeviceChoice> device;
  bool is_mirrored = false;         ///< the simulation imitates the device
  std::vector<std::string> ptys;    ///< paths of pseudo-terminals
  std::uint32_t pty_mode = 0600;    ///< rights of their slaves
  std::size_t max_per_address = 0;  ///< 0: the default
  std::size_t max_memory_mib = 512;
  std::string port_file;  ///< empty: none
  std::string record;     ///< the file of the recording; empty: none
  std::size_t record_max_mib = 1024;
  std::size_t record_total_mib = 8192;
  Tick history_ticks = 3600 * kTickHz;  ///< how long the past is kept; 0: not at all
  std::string log_level = "info";
  std::string log_file;  ///< empty: standard error
  TokenSource token;
  bool is_private = false;
  std::string metrics_token_file;  ///< empty: none
  std::vector<std::string> allow_hosts;
  std::vector<std::string> allow_origins;
  bool is_insecure = false;
  std::string config;  ///< a config file; empty: none
  OptionSources option_sources;
};

/// Whether there are, or may be, several cells.
inline bool has_many_cells(const ServeOptions& options) {
  return options.cells > 0 || !options.cell_choices.empty() || options.is_cell_per_connection;
}

struct CheckOptions {
  std::vector<std::string> files;
  std::string
      robot;  ///< to check workcells against; empty: the one with the workcell's name, if any
  Profile profile = Profile::kPaper;
};

struct DrawOptions {
  std::string out;  ///< ends in .svg or .png
  std::string robot = "rhino-xr3";
  std::string workcell;        ///< empty: the one with the robot's name
  std::vector<double> joints;  ///< joint variables from the base, degrees or mm; none: soft home
  std::optional<double> tool;  ///< tool variable, degrees or mm
  ViewVector view;
  int width_px = kUsualPictureWidthPx;
};

struct KinOptions {
  std::string robot = "rhino-xr3";  ///< name or path
  KinOptionValues values;           ///< not validated: this requires the robot
  bool is_json = false;
};

struct ConvertOptions {
  std::string in;
  std::string out;     ///< ends in .json, or in .txt or .dat for the paper's plain form
  bool force = false;  ///< replace an existing file
};

struct WorkcellOptions {
  std::string file;   ///< to create, or to change if it exists
  std::string robot;  ///< name or path; empty: the one with the file's name, else the Rhino
  std::string from;   ///< name or path of a workcell to start from; may be empty
};

/// `xr3 replay`; `server` is for going on after it.
struct ReplayCommand {
  ReplayOptions replay;
  ServeOptions server;
};

/// `xr3 exec`; `server` is for its robot.
struct ExecCommand {
  ExecOptions exec;
  ServeOptions server;
};

/// `xr3 grade`; `exec` is for each submission.
struct GradeCommand {
  GradeOptions grade;
  ExecOptions exec;
  ServeOptions server;
};

/// `xr3 manual --write`.
struct ManualFiles {
  std::string folder;
  std::vector<ManualFile> files;
};

/// Print and exit: help was requested, or the arguments are invalid.
struct Leave {
  ExitCode code = ExitCode::kGood;
  std::string to_stdout;
  std::string to_stderr;
};

using Options = std::variant<ServeOptions, CheckOptions, DrawOptions, KinOptions, ConvertOptions,
                             WorkcellOptions, WatchOptions, TermOptions, HealthOptions,
                             ReplayCommand, ExecCommand, GradeCommand, ManualFiles, Leave>;

/// Never prints. `build` is what --version prints after the version. Throws FileError if `xr3
/// completion` finds no data folder, ArgumentError if `xr3 manual` is given no command of xr3.
Options parse_options(int argc, const char* const* argv, const std::string& build = "");

/// `real`, `real:FACTOR`, `manual` or `bytes[:INQUIRY_MS[,settle=MS]]`. Throws
/// std::invalid_argument, with the allowed values.
ClockChoice parse_clock(const std::string& text);

/// `strict`, `normal` or `off`. Throws std::invalid_argument, with the allowed values.
Guard parse_guard(const std::string& text);

/// `DEVICE` or `DEVICE:9600-7e2`; the settings of a Mark III if none are given. A path may contain
/// colons. Throws std::invalid_argument.
DeviceChoice parse_device(const std::string& text);

/// `9600-7e2` or `auto`, either with `:FACTOR`, 0.001...100000. Throws std::invalid_argument, with
/// the allowed values.
LineSpeed parse_line_speed(const std::string& text);

/// The rights of a file, in octal: 0660. Throws std::invalid_argument.
std::uint32_t parse_mode(const std::string& text);

/// A time such as `90s`, `10m`, `1h`, or 0, in ticks, up to 24 hours. Throws std::invalid_argument.
Tick parse_duration(const std::string& text);

/// `x,y,z`, integers -9...9, not all 0. Throws std::invalid_argument, with the allowed values.
ViewVector parse_view(const std::string& text);

/// Rounds to millionths. Throws std::invalid_argument unless 0.001...100000.
Rate parse_rate(const std::string& text);

/// 127.0.0.0/8, ::1 or localhost: reachable from this machine only.
bool is_loopback(const std::string& address);

}  // namespace xr3
