// The options of `xr3 serve`, and the check that they are consistent.
#include <algorithm>
#include <utility>

#include "cli/options/config.hpp"
#include "cli/options/environment.hpp"
#include "cli/options/shared_options.hpp"
#include "protocol/monitor/http_guard.hpp"
#include "protocol/text/printable.hpp"
#include "server/net/asio.hpp"
#include "server/options/roster.hpp"

namespace xr3 {
namespace {

const std::vector<std::string> kLogLevels{"trace", "debug", "info", "warn", "error", "off"};
constexpr int kMaxLines = 20000;
constexpr int kMaxCells = 10000;
constexpr double kMaxLingerS = 86400;
constexpr int kMaxKeepDays = 36500;
constexpr int kMinMemoryMib = 64;
// An argument only: standard input belongs to a single process.
constexpr const char* kUntilStdinEnds = "--until-stdin-ends";

std::string check_token_word(const std::string& word) {
  return word == "auto" ? ""
                        : "accepts only the word auto: other users could read a token in the "
                          "process list; put it into a file (--token-file) or into XR3_TOKEN";
}

std::string check_host(const std::string& name) {
  return http::is_host_name(name) ? ""
                                  : name + ": a host is a name such as robot.lab, without port";
}

std::string check_origin(const std::string& text) {
  return http::is_origin(text) || text == http::kDesktopOrigin
             ? ""
             : text +
                   ": an origin has the form https://page.lab or http://a:8080, or is the word " +
                   "desktop, for apps without a site";
}

// Browsers ignore IPv6 addresses in a policy.
std::string check_frame(const std::string& text) {
  const bool is_good = http::is_origin(text) && text.find('[') == std::string::npos;
  return is_good ? ""
                 : text +
                       ": the origin of a page around this one is http:// or https://, a name or "
                       "an IPv4 address, and perhaps a port, such as http://localhost:8888";
}

// Adds a list: values separated by commas, or repeated uses of the option.
void add_names(CLI::App& serve, const std::string& name, std::vector<std::string>& names,
               const std::string& type, const std::string& what,
               std::string (*check)(const std::string&)) {
  serve.add_option(name, names, what)
      ->type_name(type)
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::Validator(check, ""));
}

void add_cells(CLI::App& serve, ServeOptions& options) {
  add_value(serve, "--cells", options.cells, "N",
            "serve N robots, the cells 1 to N, on consecutive ports from 9701 on")
      ->check(whole_number_between(1, kMaxCells));
  serve
      .add_option_function<std::vector<std::string>>(
          "--cell",
          [&options](const std::vector<std::string>& texts) {
            options.cell_choices.clear();
            for (const std::string& text : texts) options.cell_choices.push_back(parse_cell(text));
          },
          "a cell with its own robot and workcell, and perhaps port")
      ->type_name("NAME=ROBOT,WORKCELL[,PORT]")
      ->allow_extra_args(false)
      ->check(parses(parse_cell));
  add_value(serve, "--roster", options.roster, "FILE",
            "cells named after the students in this file: CSV or JSON");
  add_flag(serve, "--cell-per-connection", options.is_cell_per_connection,
           "each connection of the robot port gets a cell of its own");
  add_value(serve, "--max-cells", options.max_cells, "N", "maximum number of cells")
      ->check(whole_number_between(1, kMaxCells))
      ->capture_default_str();
  add_value(serve, "--linger", options.linger_s, "SECONDS",
            "seconds that a cell of one connection, or the owner of a port, is kept after it")
      ->check(number_between(0, kMaxLingerS))
      ->capture_default_str();
  add_flag(serve, "--bind-peer", options.binds_peer,
           "the first address that speaks on a robot port keeps it; others are disconnected");
}

void add_exercise(CLI::App& serve, ServeOptions& options) {
  CLI::Option* exercise =
      add_value(serve, "--exercise", options.exercise, "NAME|FOLDER|ZIP",
                "exercise with robot, workcell, faults and goals, which the overview shows");
  CLI::Option* goals = add_value(serve, "--goals", options.goals, "FILE",
                                 "goals of which the overview shows those that are met");
  for (const char* each : {"--robot", "--workcell", "--fault"}) exercise->excludes(each);
  exercise->excludes(goals);
}

void add_end(CLI::App& serve, ServeOptions& options) {
  add_flag(serve, kUntilStdinEnds, options.is_until_stdin_ends,
           "stop as on SIGTERM when standard input ends, as with the process at its other end");
  serve.get_option(kUntilStdinEnds)->configurable(false);
}

Leave refuse(const std::string& why) {
  return {ExitCode::kBadInput, "", "xr3: " + printable_line(why) + "\n"};
}

Leave refuse(const ServeOptions& options, const char* option, const std::string& why) {
  return refuse(source_of(options.option_sources, option) + " " + why);
}

bool is_set(const CLI::App& command, const std::string& name) {
  return command.get_option(name)->count() > 0;
}

// Adds the cells of the roster, and sets defaults that depend on the number of cells.
void complete_cells(const CLI::App& serve, ServeOptions& options) {
  if (!options.roster.empty()) {
    const auto rows = with_option_source(options.option_sources, "--roster",
                                         [&] { return load_roster(options.roster); });
    options.cell_choices.insert(options.cell_choices.end(), rows.begin(), rows.end());
  }
  const std::size_t count = options.cells + options.cell_choices.size();
  if (count > 0 && !options.is_cell_per_connection && !is_set(serve, "--robot-port"))
    options.robot_port = kFirstOfManyPorts;
  if (is_set(serve, "--max-lines")) return;
  options.max_lines =
      options.is_cell_per_connection
          ? options.max_cells
          : std::clamp<std::size_t>(kLinesOfEachCell * count, options.max_lines, kMaxLines);
}

// Options for the recordings of several cells.
std::optional<Leave> refuse_recordings(const ServeOptions& options) {
  constexpr const char* kFolder = "needs --record FOLDER and several cells: --roster or --cells";
  const bool has_folder = has_many_cells(options) && !options.record.empty();
  if (options.record_keep_days > 0 && !has_folder) return refuse(options, "--record-keep", kFolder);
  const bool has_none_to_continue = options.is_cell_per_connection && options.roster.empty();
  if (options.is_continued && (!has_folder || has_none_to_continue))
    return refuse(options, "--continue",
                  has_none_to_continue
                      ? "cannot be used with --cell-per-connection: its cells end with their lines"
                      : kFolder);
  return std::nullopt;
}

std::optional<Leave> refuse_cells(const ServeOptions& options) {
  constexpr const char* kOneCell =
      "needs a server of one cell: leave out --cells, --cell and --roster";
  const bool is_of_option =
      std::ranges::any_of(options.cell_choices, &std::string::empty, &CellChoice::source);
  if (options.is_cell_per_connection && (options.cells > 0 || is_of_option))
    return refuse(options, "--cell-per-connection", "cannot be used with --cells or --cell");
  if (options.is_cell_per_connection && !options.roster.empty() && !options.is_private)
    return refuse(options, "--cell-per-connection",
                  "with --roster needs --private: the token of a student's page tells whose robot "
                  "the connections from its machine are for");
  if (options.is_cell_per_connection && options.binds_peer)
    return refuse(options, "--bind-peer",
                  "cannot be used with --cell-per-connection: there each client has its own cell");
  if (auto refused = refuse_recordings(options)) return refused;
  if (has_many_cells(options) && !options.ptys.empty()) return refuse(options, "--pty", kOneCell);
  if (has_many_cells(options) && options.device) return refuse(options, "--serial", kOneCell);
  try {
    plan_cells(options);
  } catch (const CellPlanError& error) {
    return refuse(error.what());
  }
  return std::nullopt;
}

// Completes the options. Called after CLI11 has read arguments and environment; the config file has
// lower precedence.
void complete(CLI::App& serve, ServeOptions& options) {
  if (is_argument(serve, "--token") && is_argument(serve, "--token-file"))
    throw CLI::ExcludesError("--token", "--token-file");
  options.option_sources = complete_from_environment(serve);
  const bool has_token = !std::holds_alternative<NoToken>(options.token);
  if (!has_token && is_token_in_environment()) options.token = TokenInEnvironment{};
  read_config(serve, options.config, OtherKeys::kRefuse, options.option_sources);
  complete_cells(serve, options);
}

}  // namespace

void add_machine(CLI::App& command, ServeOptions& options) {
  add_value(command, "--robot", options.robot, "NAME|FILE", "robot: a name, or a file")
      ->capture_default_str();
  add_value(
      command, "--workcell", options.workcell, "NAME|FILE",
      "workcell: a name, a file, or none: an empty table (default: the robot's name, or none)");
  add_value(command, "--fault", options.fault_file, "NAME|FILE",
            "faults of the robot and its lines: a name, or a file");
}

void add_time(CLI::App& command, ServeOptions& options, const std::string& clocks) {
  add_profile(command, options.profile);
  add_parsed(command, "--clock", options.clock, parse_clock,
             "real[:FACTOR]|manual|bytes[:INQUIRY_MS[,settle=MS]]", clocks);
  add_flag(command, "--concurrent-lines", options.has_concurrent_lines,
           "with --clock bytes: all lines are obeyed together, not one at a time");
}

void add_line_speed(CLI::App& command, ServeOptions& options) {
  add_parsed(command, "--line-speed", options.line_speed, parse_line_speed,
             "9600-7e2|auto[:FACTOR]",
             "time that bytes of serial lines take, by these settings or those of the client");
}

void add_ports(CLI::App& serve, ServeOptions& options) {
  add_value(serve, "--listen", options.listen, "ADDR",
            "address to listen on; any except loopback needs a token or --insecure")
      ->check(CLI::Validator(check_listen, ""))
      ->capture_default_str();
  add_value(serve, "--robot-port", options.robot_port, "PORT",
            "port of the serial lines; 0 takes a free one")
      ->check(CLI::Validator(check_port, ""))
      ->capture_default_str();
  add_value(serve, "--monitor-port", options.monitor_port, "PORT",
            "port of the JSON monitor; 0 takes a free one")
      ->check(CLI::Validator(check_port, ""))
      ->capture_default_str();
}

void add_port_file(CLI::App& serve, ServeOptions& options) {
  add_value(serve, "--port-file", options.port_file, "FILE",
            "write the ports to this file as JSON when the server is ready");
}

void add_recording(CLI::App& serve, ServeOptions& options) {
  add_value(serve, "--record", options.record, "FILE",
            "record inputs and replies in this file, or for several cells in this folder");
  add_value(serve, "--record-max", options.record_max_mib, "MIB",
            "maximum size of the recording in MiB; the robot goes on without it")
      ->check(whole_number_between(1, kMaxMemoryMib))
      ->capture_default_str();
  add_value(serve, "--record-total", options.record_total_mib, "MIB",
            "maximum size of all recordings of this run together in MiB")
      ->check(whole_number_between(1, kMaxMemoryMib))
      ->capture_default_str();
  add_value(serve, "--record-keep", options.record_keep_days, "DAYS",
            "with several cells: delete recordings that are older; 0 (default) keeps all")
      ->check(whole_number_between(0, kMaxKeepDays));
  add_flag(serve, "--continue", options.is_continued,
           "with several cells: go on from where their last recordings end");
}

void add_log(CLI::App& serve, ServeOptions& options) {
  add_value(serve, "--log-level", options.log_level, "L", "trace, debug, info, warn, error or off")
      ->check(CLI::IsMember(kLogLevels).description(""))
      ->capture_default_str();
  add_value(serve, "--log-file", options.log_file, "FILE",
            "write the log to this file, rotated at 10 MB, at most 5 files; else to standard "
            "error");
}

void add_access(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option_function<std::string>(
          "--token-file",
          [&options](const std::string& path) {
            if (std::holds_alternative<NoToken>(options.token)) options.token = TokenFile{path};
          },
          "file with the token that monitor calls need (or use XR3_TOKEN); at least 16 characters")
      ->type_name("FILE");
  // Added after --token-file, so that it replaces a file named by the environment.
  serve
      .add_option_function<std::string>(
          "--token", [&options](const std::string&) { options.token = FreshToken{}; },
          "auto: generate a token for this run, printed on standard error; excludes --token-file")
      ->type_name("auto")
      ->check(CLI::Validator(check_token_word, ""))
      ->configurable(false);
  add_flag(serve, "--private", options.is_private, "reading needs the token, too");
  add_value(serve, "--metrics-token-file", options.metrics_token_file, "FILE",
            "with --private: file with a token for /metrics alone, sent as Authorization: Bearer");
  add_names(serve, "--allow-host", options.allow_hosts, "NAME",
            "host name that browsers may use for this machine; several with commas", check_host);
  add_names(
      serve, "--allow-origin", options.allow_origins, "ORIGIN",
      "pages that may connect, as https://page.lab; desktop: Foxglove's apps; several with commas",
      check_origin);
  add_names(serve, "--allow-frame", options.allow_frames, "ORIGIN",
            "origin of pages that may show this page in a frame; several with commas", check_frame);
  add_flag(serve, "--insecure", options.is_insecure,
           "allow other machines without a token: anyone who can connect can control the robot");
}

void add_serve(CLI::App& app, ServeOptions& options) {
  CLI::App& serve = *app.add_subcommand("serve", "start a robot and its controller");
  add_machine(serve, options);
  add_exercise(serve, options);
  add_ports(serve, options);
  add_cells(serve, options);
  add_time(serve, options,
           "real (default), FACTOR times as fast; manual: by the monitor; bytes: by the programs");
  add_value(serve, "--max-lines", options.max_lines, "N",
            "maximum number of open robot connections (default: 64, more with many cells)")
      ->check(whole_number_between(1, kMaxLines));
  add_value(serve, "--max-per-address", options.max_per_address, "N",
            "maximum number of connections of one address on each port")
      ->check(whole_number_between(1, kMaxLines));
  add_value(serve, "--max-memory", options.max_memory_mib, "MIB",
            "MiB of memory beyond which the greediest client is disconnected")
      ->check(whole_number_between(kMinMemoryMib, kMaxMemoryMib))
      ->capture_default_str();
  add_parsed(serve, "--guard", options.guard, parse_guard, "strict|normal|off",
             "which clients the robot port disconnects by their first bytes (default: normal)");
  add_parsed(serve, "--serial", options.device, parse_device, "DEVICE[:9600-7e2]",
             "physical controller that gets the commands while the simulator is disabled (A@)");
  add_flag(serve, "--mirror", options.is_mirrored,
           "with --serial: the simulation carries out the commands of the device, too");
  add_line_speed(serve, options);
  add_value(serve, "--pty", options.ptys, "PATH",
            "also serve a pseudo-terminal, with a link to it at this path")
      ->allow_extra_args(false)
      ->delimiter(',');
  add_parsed(serve, "--pty-mode", options.pty_mode, parse_mode, "MODE",
             "rights of the pseudo-terminals, in octal (default: 0600)");
  add_port_file(serve, options);
  add_recording(serve, options);
  add_parsed(serve, "--history", options.history_ticks, parse_duration, "90s|10m|1h|0",
             "how long the past of a cell is kept, to look at it and go back to it (default: 1h)");
  add_log(serve, options);
  add_access(serve, options);
  add_end(serve, options);
  add_config(serve, options.config);
  read_environment(serve, {"--token", kUntilStdinEnds});
  serve.parse_complete_callback([&serve, &options] { complete(serve, options); });
}

Options checked_serve(ServeOptions options) {
  const bool has_token = !std::holds_alternative<NoToken>(options.token);
  const bool is_beyond = !is_loopback(options.listen);
  if (options.is_private && !has_token)
    return refuse(options, "--private",
                  "needs a token: --token-file FILE, XR3_TOKEN or --token auto");
  if (!options.metrics_token_file.empty() && !options.is_private)
    return refuse(options, "--metrics-token-file",
                  "needs --private: without it reading /metrics needs no token");
  if (is_beyond && !has_token && !options.is_insecure)
    return refuse(
        options, "--listen",
        options.listen +
            " accepts other machines: set a token for calls with --token-file FILE "
            "(XR3_TOKEN_FILE), XR3_TOKEN or --token auto (the robot port still has no password), "
            "or use --insecure (XR3_INSECURE=1)");
  if (options.is_mirrored && !options.device)
    return refuse(options, "--mirror", "needs --serial DEVICE");
  if (options.device && !options.fault_file.empty())
    return refuse(options, "--fault",
                  "cannot be used with --serial: faults are for the simulation, not for an arm");
  if (options.device && !(options.clock == ClockChoice{}))
    return refuse(options, "--serial",
                  "needs --clock real: a physical arm does not run faster or wait");
  if (options.has_concurrent_lines && options.clock.mode != ClockMode::kBytes)
    return refuse(options, "--concurrent-lines",
                  "needs --clock bytes: with the other clocks all lines are obeyed together");
  if (options.has_concurrent_lines && options.clock.bytes.settle_ms)
    return refuse(
        options, "--concurrent-lines",
        "cannot be used with settle=: the silence of one line says nothing of the others");
  if (options.device && options.line_speed)
    return refuse(options, "--line-speed",
                  "cannot be used with --serial: the arm's port has a speed of its own");
  if (!options.allow_frames.empty() && (has_token || options.device))
    return refuse(options, "--allow-frame",
                  "cannot be used with " + std::string(has_token ? "a token" : "--serial") +
                      ": a page can trick its visitor into clicking in a frame, so it is for "
                      "simulated robots that anybody may move");
  if (auto refused = refuse_cells(options)) return *std::move(refused);
  if (options.device && is_beyond && !has_token)
    return refuse(options, "--serial",
                  "with --listen beyond this machine needs a token, also with --insecure");
  return options;
}

}  // namespace xr3
