// The parsed command line as values, or the error in it. No side effects.
//
// The flow through the folder: parse_options() builds the command line of CLI11: for each command
// the function add_NAME() of its own source adds a subcommand and binds each option to a member of
// the command's struct; shared_options.hpp has options of several commands and the validators.
// Values come, in order of precedence, from arguments, from environment variables (environment.hpp:
// XR3_ROBOT_PORT for --robot-port) and from a config file (config.hpp). Each source is kept, so
// that an error names it. An error of CLI11 becomes one sentence with the name that was probably
// meant (argument_error.hpp). Checks that concern several options follow. The result is one
// alternative of the variant Options, which main.cpp executes, or Leave with a text to print: help,
// version, or the error. The options of `serve` that the server needs are in
// server/options/options.hpp. manual.hpp describes all of this for manual pages and completions.
// Only files that define options include CLI11 (cli_fwd.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cell/byte_clock.hpp"
#include "cli/options/exec.hpp"
#include "cli/options/exercise.hpp"
#include "cli/options/export.hpp"
#include "cli/options/healthcheck.hpp"
#include "cli/options/manual.hpp"
#include "cli/options/replay.hpp"
#include "cli/options/term.hpp"
#include "cli/options/watch.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "server/base/exit_code.hpp"
#include "server/options/options.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/kin/question.hpp"

namespace xr3 {

struct CheckOptions {
  std::vector<std::string> files;
  std::string
      robot;  ///< robot for checks of workcells; empty for the one with the workcell's name, if any
  Profile profile = Profile::kPaper;
};

struct DrawOptions {
  std::string out;  ///< ends in .svg or .png
  std::string robot = kUsualRobot;
  std::string workcell;  ///< empty for the one with the robot's name
  /// Joint variables from the base, degrees or mm; empty for the soft home.
  std::vector<double> joints;
  std::optional<double> tool;  ///< tool variable, degrees or mm
  ViewVector view;
  int width_px = kUsualPictureWidthPx;
};

struct KinOptions {
  std::string robot = kUsualRobot;  ///< name or path
  KinOptionValues values;           ///< not validated, which requires the robot
  bool is_json = false;
};

struct ConvertOptions {
  std::string in;
  std::string out;     ///< ends in .json, in .txt or .dat for the paper's plain form, or in .mcap
  bool force = false;  ///< replace an existing file
  std::optional<int> every_ms;  ///< with .mcap: simulated time between two samples
};

struct WorkcellOptions {
  std::string file;   ///< to create, or to change if it exists
  std::string robot;  ///< name or path; empty for the one with the file's name, else the Rhino
  std::string from;   ///< name or path of a workcell to start from; may be empty
};

/// `xr3 replay`; `server` is for serving after it.
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

/// A text to print before the exit: help was requested, or the arguments are invalid.
struct Leave {
  ExitCode code = ExitCode::kGood;
  std::string to_stdout;
  std::string to_stderr;
};

using Options =
    std::variant<ServeOptions, CheckOptions, DrawOptions, KinOptions, ConvertOptions, ExportOptions,
                 WorkcellOptions, WatchOptions, TermOptions, HealthOptions, ReplayCommand,
                 ExecCommand, GradeCommand, ExerciseOptions, ManualFiles, Leave>;

/// Parses the command line; never prints. `build` is what --version prints after the version.
/// Throws FileError if `xr3 completion` finds no data folder, ArgumentError if `xr3 manual` is
/// given no command of xr3.
Options parse_options(int argc, const char* const* argv, const std::string& build = "");

/// Parses `real`, `real:FACTOR`, `manual` or `bytes[:INQUIRY_MS[,settle=MS]]`. Throws
/// std::invalid_argument, with the allowed values.
ClockChoice parse_clock(const std::string& text);

/// Parses `strict`, `normal` or `off`. Throws std::invalid_argument, with the allowed values.
Guard parse_guard(const std::string& text);

/// Parses `DEVICE` or `DEVICE:9600-7e2`; the settings of a Mark III if none are given. A path may
/// contain colons. Throws std::invalid_argument.
DeviceChoice parse_device(const std::string& text);

/// Parses `9600-7e2` or `auto`, either with `:FACTOR`, 0.001...100000. Throws
/// std::invalid_argument, with the allowed values.
LineSpeed parse_line_speed(const std::string& text);

/// Parses the rights of a file, in octal: 0660. Throws std::invalid_argument.
std::uint32_t parse_mode(const std::string& text);

/// Parses a time such as `90s`, `10m`, `1h`, or 0, into ticks, up to 24 hours. Throws
/// std::invalid_argument.
Tick parse_duration(const std::string& text);

/// Parses a rate, rounded to millionths. Throws std::invalid_argument unless 0.001...100000.
Rate parse_rate(const std::string& text);

}  // namespace xr3
