#include "cli/options/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "cli/options/argument_error.hpp"
#include "cli/options/environment.hpp"
#include "cli/options/manual.hpp"
#include "cli/options/pose_argument.hpp"
#include "cli/options/shared_options.hpp"
#include "protocol/text/text_stream.hpp"
#include "protocol/text/whole_number.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/view_vector.hpp"

namespace xr3 {
namespace {

constexpr const char* kAbout =
    "xr3: a robot controller behind TCP ports that stands in for a real Rhino XR-3 and its like.\n"
    "Each connection to the robot port is a serial line; the monitor port speaks JSON lines.";

constexpr const char* kFooter =
    "Exit codes: 0 success; 1 internal error; 2 invalid arguments or an invalid file;\n"
    "            3 a port or device is in use; 4 xr3 watch or xr3 term finds no server, an\n"
    "            inquiry by xr3 term has no reply, or xr3 healthcheck finds no server that is\n"
    "            ready; 5 the server failed while running (see its log), or goals were missed;\n"
    "            6 the program of xr3 exec failed; 7 it reached a limit; 8 xr3 replay found a\n"
    "            difference, or repeated runs differ.\n"
    "Try: xr3 serve, then in another terminal: xr3 term (or telnet localhost 9600), and type\n"
    "     E+50, Enter and E?";

void add_check(CLI::App& app, CheckOptions& options) {
  CLI::App& check =
      *app.add_subcommand("check", "validate robot, workcell and fault files and summarise them");
  add_value(check, "files", options.files, "FILE", "the files: JSON, or the paper's plain form")
      ->required();
  add_value(check, "--robot", options.robot, "NAME|FILE",
            "check workcells against this robot's tool, and faults against its joints");
  add_profile(check, options.profile);
}

std::string check_picture_name(const std::string& name) {
  const bool is_good = name.ends_with(".svg") || name.ends_with(".png");
  return is_good ? "" : name + ": a picture's name ends in .svg or .png";
}

void add_draw(CLI::App& app, DrawOptions& options) {
  CLI::App& draw = *app.add_subcommand("draw", "draw a robot and its workcell as a picture");
  add_value(draw, "out", options.out, "OUT.svg|OUT.png",
            "the picture file; its name determines the format")
      ->required()
      ->check(CLI::Validator(check_picture_name, ""));
  add_value(draw, "--robot", options.robot, "NAME|FILE", "robot: a name, or a file")
      ->capture_default_str();
  add_value(
      draw, "--workcell", options.workcell, "NAME|FILE",
      "workcell: a name, a file, or none: an empty table (default: the robot's name, or none)");
  add_parsed(draw, "--joints", options.joints, parse_numbers, "V1,V2,...",
             "joint variables from the base on, degrees or mm (default: soft home)");
  add_value(draw, "--tool", options.tool, "V", "tool variable, mm or degrees (default: soft home)");
  add_parsed(draw, "--view", options.view, parse_view, "X,Y,Z",
             "view vector: whole numbers from -9 to 9 (default 1,1,1)");
  add_value(draw, "--width", options.width_px, "PX", "width in pixels")
      ->check(whole_number_between(kMinPictureWidthPx, kMaxPictureWidthPx))
      ->capture_default_str();
}

void add_kin(CLI::App& app, KinOptions& options) {
  CLI::App& kin = *app.add_subcommand(
      "kin",
      "forward and inverse kinematics: the pose for joint values, or joint values for a pose");
  KinOptionValues& values = options.values;
  add_value(kin, "--robot", options.robot, "NAME|FILE", "robot: a name, or a file")
      ->capture_default_str();
  add_parsed(kin, "--joints", values.joints, parse_numbers, "V1,...",
             "joint variables from the base, degrees or mm");
  add_parsed(kin, "--counts", values.counts, parse_numbers, "N1,...", "motor counts from the base");
  add_value(kin, "--tool", values.tool, "V",
            "with --joints or --counts: the tool variable, mm or degrees");
  add_parsed(kin, "--pose", values.pose, parse_numbers, "X,Y,Z[,YAW,PITCH,ROLL]",
             "tip in mm; orientation R = Rz(yaw) Ry(pitch) Rx(roll) in degrees");
  add_value(kin, "--down", values.down, "NET_ROLL",
            "with X,Y,Z: tool straight down at this net roll, degrees");
  add_parsed(kin, "--approach", values.approach, parse_numbers, "AX,AY,AZ",
             "with X,Y,Z: the approach vector");
  add_value(kin, "--roll", values.roll, "Q", "with --approach: the variable of the last joint");
  add_value(kin, "--slide", values.slide, "MM",
            "with a target: the place of the slide on which the arm stands, mm; default: its home");
  add_parsed(kin, "--configuration", values.configuration, parse_numbers, "W1,...,W6",
             "tool-configuration vector");
  add_value(kin, "--tolerance", values.tolerance.tolerance_deg, "DEG",
            "maximum error of the approach vector, if the arm cannot reach it exactly")
      ->check(number_between(0, 45))
      ->capture_default_str();
  add_value(kin, "--tolerance-mm", values.tolerance.tolerance_mm, "MM",
            "maximum error of the tip, mm")
      ->check(number_between(0, 1000))
      ->capture_default_str();
  kin.add_flag("--json", options.is_json, "everything as JSON");
}

void add_convert(CLI::App& app, ConvertOptions& options) {
  CLI::App& convert = *app.add_subcommand(
      "convert",
      "turn a robot or workcell file into the paper's plain form, or back into JSON; or a "
      "recording into a file for Foxglove");
  add_value(convert, "in", options.in, "IN", "the file, of either form, or a recording")
      ->required();
  add_value(convert, "out", options.out, "OUT",
            "the new file: .json, or .txt or .dat for the plain form; .mcap for a recording")
      ->required();
  add_value(convert, "--every", options.every_ms, "MS",
            "with OUT.mcap: simulated ms between two samples of a moving robot (default 100)")
      ->check(whole_number_between(1, kMaxEveryMs));
  convert.add_flag("--force", options.force, "replace OUT if it is there already");
}

void add_workcell(CLI::App& app, WorkcellOptions& options) {
  CLI::App& workcell =
      *app.add_subcommand("workcell", "make a workcell file, or change one, question by question");
  add_value(workcell, "file", options.file, "NEW.json", "the file; opened if it is there already")
      ->required();
  add_value(workcell, "--robot", options.robot, "NAME|FILE",
            "robot to check against (default: named like the file, else rhino-xr3)");
  add_value(workcell, "--from", options.from, "NAME|FILE",
            "begin with this workcell: a name, or a file");
}

bool is_help_wanted(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return !commands.empty() && commands.front()->get_help_ptr()->count() > 0;
}

// The result for an error of parsing: help and version are printed as they are; an error becomes
// one sentence.
Leave leave(const CLI::App& app, const CLI::ParseError& error,
            const std::vector<std::string>& arguments) {
  if (error.get_exit_code() != 0 && is_help_wanted(app)) return {ExitCode::kGood, app.help(), ""};
  if (error.get_exit_code() != 0) {
    return {ExitCode::kBadInput, "",
            "xr3: " + describe_argument_error(app, error, arguments) + "\n"};
  }
  TextStream out;
  TextStream err;
  app.exit(error, out, err);
  return {ExitCode::kGood, out.str(), err.str()};
}

Options checked_manual(const CLI::App& app, const ManualOptions& options) {
  if (!options.folder.empty()) return ManualFiles{options.folder, manual_files(app)};
  return Leave{ExitCode::kGood, manual_page(app, options), ""};
}

Options checked_replay(ReplayCommand command) {
  if (!command.replay.is_serving) return command;
  const bool has_token = !std::holds_alternative<NoToken>(command.server.token);
  if (!has_token && is_token_in_environment()) command.server.token = TokenInEnvironment{};
  Options checked = checked_serve(command.server);
  if (std::holds_alternative<Leave>(checked)) return checked;
  return command;
}

}  // namespace

Rate parse_rate(const std::string& text) {
  const auto refuse = [&] {
    throw std::invalid_argument(text + ": a rate is a number 0.001...100000");
  };
  std::size_t end = 0;
  double factor = 0;
  try {
    factor = std::stod(text, &end);
  } catch (const std::exception&) {
    refuse();
  }
  const Rate rate{static_cast<std::int64_t>(factor >= 0 && factor < 1e6 ? factor * 1e6 + 0.5 : 0)};
  const bool is_allowed =
      rate.millionths >= kSlowest.millionths && rate.millionths <= kFastest.millionths;
  if (end != text.size() || !is_allowed) refuse();
  return rate;
}

Guard parse_guard(const std::string& text) {
  if (text == "strict") return Guard::kStrict;
  if (text == "normal") return Guard::kNormal;
  if (text == "off") return Guard::kOff;
  throw std::invalid_argument(text + ": a guard is strict, normal or off");
}

DeviceChoice parse_device(const std::string& text) {
  DeviceChoice choice{text, {kDefaultBaud, SerialFrame{}}};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || text.find('/', colon) != std::string::npos) return choice;
  const auto settings = parse_serial_settings(std::string_view(text).substr(colon + 1));
  if (!settings || !settings->frame) {
    throw std::invalid_argument(text +
                                ": a device is a path, or a path and settings such as "
                                "/dev/ttyUSB0:9600-7e2");
  }
  return {text.substr(0, colon), *settings};
}

LineSpeed parse_line_speed(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string speed = text.substr(0, colon);
  const auto settings = parse_serial_settings(speed);
  const bool is_complete =
      settings && settings->frame && settings->frame->flow == FlowControl::kNone;
  if (speed != "auto" && !is_complete) {
    throw std::invalid_argument(text +
                                ": a line speed is speed, data bits, parity and stop bits such as "
                                "9600-7e2, or auto, either "
                                "with :FACTOR");
  }
  const Rate factor = colon == std::string::npos ? Rate{} : parse_rate(text.substr(colon + 1));
  return {settings, factor};
}

std::uint32_t parse_mode(const std::string& text) {
  constexpr std::uint32_t kMaxMode = 0777;
  if (const auto mode = whole_number<std::uint32_t>(text, 0, kMaxMode, 8)) return *mode;
  throw std::invalid_argument(text + ": a mode has three octal digits, as in 0660");
}

Tick parse_duration(const std::string& text) {
  constexpr Tick kMost = kMaxHistory / kTickHz;
  Tick number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  const std::string_view unit(end, static_cast<std::size_t>(last - end));
  Tick seconds = 0;
  if (unit == "s") seconds = 1;
  if (unit == "m") seconds = 60;
  if (unit == "h") seconds = 3600;
  const bool is_zero = error == std::errc() && number == 0 && unit.empty();
  const bool is_good = error == std::errc() && number >= 0 && number <= kMost && seconds > 0 &&
                       number * seconds <= kMost;
  if (is_zero || is_good) return number * seconds * kTickHz;
  throw std::invalid_argument(text + ": a time such as 90s, 10m or 1h, at most 24h, or 0");
}

ClockChoice parse_clock(const std::string& text) {
  if (text == "manual") return {ClockMode::kManual, Rate{}, {}};
  if (text == "real") return {ClockMode::kReal, Rate{}, {}};
  if (text.starts_with("real:")) return {ClockMode::kReal, parse_rate(text.substr(5)), {}};
  if (text == "bytes" || text.starts_with("bytes:"))
    return {ClockMode::kBytes, Rate{}, parse_byte_clock(text)};
  throw std::invalid_argument(text +
                              ": a clock is real, real:FACTOR, manual, or "
                              "bytes[:INQUIRY_MS[,settle=MS]]");
}

Options parse_options(int argc, const char* const* argv, const std::string& build) {
  CLI::App app(kAbout, "xr3");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_version_flag("--version", "xr3 " XR3_VERSION + build);
  ServeOptions serve;
  CheckOptions check;
  DrawOptions draw;
  add_serve(app, serve);
  add_check(app, check);
  add_draw(app, draw);
  KinOptions kin;
  add_kin(app, kin);
  ConvertOptions convert;
  add_convert(app, convert);
  ExportOptions exporting;
  add_export(app, exporting);
  WorkcellOptions workcell;
  add_workcell(app, workcell);
  WatchOptions watch;
  add_watch(app, watch);
  TermOptions term;
  add_term(app, term);
  HealthOptions health;
  add_health(app, health);
  ReplayCommand replay;
  add_replay(app, replay.replay, replay.server);
  ExecCommand exec;
  add_exec(app, exec.exec, exec.server);
  GradeCommand grade;
  add_grade(app, grade.grade, grade.exec, grade.server);
  ExerciseOptions exercise;
  add_exercise(app, exercise);
  ManualOptions manual;
  add_manual(app, manual);
  add_completion(app, manual);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return leave(app, error, {argv + 1, argv + argc});
  }
  if (app.got_subcommand("check")) return check;
  if (app.got_subcommand("draw")) return draw;
  if (app.got_subcommand("kin")) return kin;
  if (app.got_subcommand("convert")) return convert;
  if (app.got_subcommand("export")) return exporting;
  if (app.got_subcommand("workcell")) return workcell;
  if (app.got_subcommand("watch")) return watch;
  if (app.got_subcommand("term")) return term;
  if (app.got_subcommand("healthcheck")) return health;
  if (app.got_subcommand("replay")) return checked_replay(std::move(replay));
  if (app.got_subcommand("exec")) return exec;
  if (app.got_subcommand("grade")) return grade;
  if (app.got_subcommand("exercise")) return exercise;
  if (app.got_subcommand("manual")) return checked_manual(app, manual);
  if (app.got_subcommand("completion"))
    return Leave{ExitCode::kGood, completion_text(app, manual), ""};
  return checked_serve(std::move(serve));
}

}  // namespace xr3
