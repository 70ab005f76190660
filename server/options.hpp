// The command line as values. Nothing here acts: it says what was asked for, or what is wrong with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "protocol/drawing.hpp"
#include "protocol/kin_question.hpp"
#include "server/exit_code.hpp"
#include "server/health_options.hpp"
#include "server/origins.hpp"
#include "server/token.hpp"
#include "server/watch_options.hpp"

namespace xr3 {

/// How time begins: following the wall clock at a rate, or standing until the monitor moves it.
struct ClockChoice {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};

struct ServeOptions {
  std::string robot = "rhino-xr3";    ///< name or path
  std::string workcell;               ///< name or path; empty: the one named like the robot
  std::string listen = "localhost";   ///< this: 127.0.0.1 and, where there is IPv6, ::1
  std::uint16_t robot_port = 9600;    ///< 0 takes a free one
  std::uint16_t monitor_port = 9601;  ///< 0 takes a free one
  Profile profile = Profile::kPaper;
  ClockChoice clock;
  std::size_t most_lines = 1024;
  std::string port_file;  ///< empty: none
  std::string log_level = "info";
  TokenSource token;  ///< not read yet
  bool is_private = false;
  std::vector<std::string> allow_hosts;
  std::vector<std::string> allow_origins;
  bool is_insecure = false;
  std::string config;  ///< a file with more of these; empty: none
  Origins origins;
};

struct CheckOptions {
  std::vector<std::string> files;
  std::string
      robot;  ///< check workcells against it; empty: the one named like the workcell, if any
  Profile profile = Profile::kPaper;
};

struct DrawOptions {
  std::string out;  ///< ends in .svg or .png
  std::string robot = "rhino-xr3";
  std::string workcell;        ///< empty: the one named like the robot
  std::vector<double> joints;  ///< joint variables from the base, degrees or mm; none: soft home
  std::optional<double> tool;  ///< tool variable, degrees or mm
  ViewVector view;
  int width_px = kUsualPictureWidthPx;
};

struct KinOptions {
  std::string robot = "rhino-xr3";  ///< name or path
  KinOptionValues values;           ///< not checked yet: that takes the robot
  bool is_json = false;
};

struct ConvertOptions {
  std::string in;
  std::string out;     ///< ends in .json, or in .txt or .dat for the paper's plain form
  bool force = false;  ///< replace a file that is there
};

struct WorkcellOptions {
  std::string file;   ///< to be made, or changed if it is there
  std::string robot;  ///< name or path; empty: the one named like the file, else the Rhino
  std::string from;   ///< name or path of a workcell to begin with; may be empty
};

/// Nothing to do but to leave: help was asked for, or the arguments are wrong.
struct Leave {
  ExitCode code = ExitCode::kGood;
  std::string to_stdout;
  std::string to_stderr;
};

using Options = std::variant<ServeOptions, CheckOptions, DrawOptions, KinOptions, ConvertOptions,
                             WorkcellOptions, WatchOptions, HealthOptions, Leave>;

/// Never throws and never prints.
Options parse_options(int argc, const char* const* argv);

/// `real`, `real:FACTOR` or `manual`. Throws std::invalid_argument with what is allowed.
ClockChoice parse_clock(const std::string& text);

/// `x,y,z`, whole numbers -9...9, not all 0. Throws std::invalid_argument with what is allowed.
ViewVector parse_view(const std::string& text);

/// Exactly, in millionths. Throws std::invalid_argument unless 0.001...100000.
Rate parse_rate(const std::string& text);

/// 127.0.0.0/8, ::1 or localhost: reachable from this machine only.
bool is_loopback(const std::string& address);

}  // namespace xr3
