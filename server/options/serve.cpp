// The options of `xr3 serve`, and the check that they are consistent.
#include <algorithm>
#include <utility>

#include "protocol/monitor/http_guard.hpp"
#include "server/net/asio.hpp"
#include "server/options/config.hpp"
#include "server/options/environment.hpp"
#include "server/options/shared_options.hpp"

namespace xr3 {
namespace {

const std::vector<std::string> kLogLevels{"trace", "debug", "info", "warn", "error", "off"};
constexpr int kMaxLines = 20000;
constexpr int kMaxCells = 10000;
constexpr double kMaxLingerS = 86400;
constexpr int kMinMemoryMib = 64;
constexpr int kMaxMemoryMib = 1 << 20;

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
  return http::is_origin(text)
             ? ""
             : text + ": an origin has the form https://page.lab or http://a:8080";
}

// A list: values separated by commas, or repeated uses of the option.
void add_names(CLI::App& serve, const std::string& name, std::vector<std::string>& names,
               const std::string& type, const std::string& what,
               std::string (*check)(const std::string&)) {
  serve.add_option(name, names, what)
      ->type_name(type)
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::Validator(check, ""));
}

void add_device(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option_function<std::string>(
          "--serial", [&options](const std::string& text) { options.device = parse_device(text); },
          "physical controller that gets the commands while the simulator is disabled (A@)")
      ->type_name("DEVICE[:9600-7e2]")
      ->check(parses(parse_device, ""));
  add_flag(serve, "--mirror", options.is_mirrored,
           "with --serial: the simulation carries out the commands of the device, too");
}

void add_cells(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option("--cells", options.cells,
                  "serve N robots, the cells 1 to N, on consecutive ports from 9701 on")
      ->type_name("N")
      ->check(whole_number_between(1, kMaxCells));
  serve
      .add_option_function<std::vector<std::string>>(
          "--cell",
          [&options](const std::vector<std::string>& texts) {
            options.cell_choices.clear();
            for (const std::string& text : texts) options.cell_choices.push_back(parse_cell(text));
          },
          "a cell with its own robot and workcell, and perhaps port; repeatable")
      ->type_name("NAME=ROBOT,WORKCELL[,PORT]")
      ->allow_extra_args(false)
      ->check(parses(parse_cell, ""));
  add_flag(serve, "--cell-per-connection", options.is_cell_per_connection,
           "each connection of the robot port gets a cell of its own");
  serve.add_option("--max-cells", options.max_cells, "maximum number of cells")
      ->type_name("N")
      ->check(whole_number_between(1, kMaxCells))
      ->capture_default_str();
  serve
      .add_option("--linger", options.linger_s,
                  "seconds that a cell of one connection, or the owner of a port, is kept after it")
      ->type_name("SECONDS")
      ->check(number_between(0, kMaxLingerS))
      ->capture_default_str();
  add_flag(serve, "--bind-peer", options.binds_peer,
           "the first address that speaks on a robot port keeps it; others are disconnected");
}

void add_recording(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option(
          "--record", options.record,
          "record all inputs and replies in this new file, or for several cells in this folder")
      ->type_name("FILE");
  serve
      .add_option("--record-max", options.record_max_mib,
                  "maximum size of the recording in MiB; the robot goes on without it")
      ->type_name("MIB")
      ->check(whole_number_between(1, kMaxMemoryMib))
      ->capture_default_str();
}

void add_history(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option_function<std::string>(
          "--history",
          [&options](const std::string& text) { options.history_ticks = parse_duration(text); },
          "how long the past of a cell is kept, to look at it and go back to it (default: 1h)")
      ->type_name("90s|10m|1h|0")
      ->check(parses(parse_duration, ""));
}

void add_ptys(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option("--pty", options.ptys,
                  "also serve a pseudo-terminal, with a link to it at this path; repeatable")
      ->type_name("PATH")
      ->allow_extra_args(false)
      ->delimiter(',');
  serve
      .add_option_function<std::string>(
          "--pty-mode",
          [&options](const std::string& text) { options.pty_mode = parse_mode(text); },
          "rights of the pseudo-terminals, in octal (default: 0600)")
      ->type_name("MODE")
      ->check(parses(parse_mode, ""));
}

Leave refuse(const std::string& why) { return {ExitCode::kBadInput, "", "xr3: " + why + "\n"}; }

Leave refuse_listen(const ServeOptions& options) {
  return refuse(
      source_of(options.option_sources, "--listen") + " " + options.listen +
      " accepts other machines: set a token for calls with --token-file FILE (XR3_TOKEN_FILE), "
      "XR3_TOKEN or --token auto (the robot port still has no password), or use "
      "--insecure (XR3_INSECURE=1)");
}

bool is_set(const CLI::App& command, const std::string& name) {
  return command.get_option(name)->count() > 0;
}

// Defaults that depend on the number of cells.
void complete_cells(const CLI::App& serve, ServeOptions& options) {
  constexpr std::size_t kLinesOfEach = 4;
  const std::size_t count = options.cells + options.cell_choices.size();
  if (count == 0) return;
  if (!is_set(serve, "--robot-port")) options.robot_port = kFirstOfManyPorts;
  if (!is_set(serve, "--max-lines"))
    options.max_lines =
        std::min<std::size_t>(kMaxLines, std::max(options.max_lines, kLinesOfEach * count));
}

std::optional<Leave> refuse_cells(const ServeOptions& options) {
  const auto named = [&](const char* name) { return source_of(options.option_sources, name); };
  const bool is_listed = options.cells > 0 || !options.cell_choices.empty();
  if (options.is_cell_per_connection && is_listed)
    return refuse(named("--cell-per-connection") + " cannot be used with --cells or --cell");
  if (options.is_cell_per_connection && options.binds_peer)
    return refuse(named("--bind-peer") +
                  " cannot be used with --cell-per-connection: there each client has its own cell");
  if (has_many_cells(options) && !options.ptys.empty())
    return refuse(named("--pty") + " needs a server of one cell: leave out --cells and --cell");
  if (has_many_cells(options) && options.device)
    return refuse(named("--serial") + " needs a server of one cell: leave out --cells and --cell");
  try {
    plan_cells(options);
  } catch (const CellPlanError& error) {
    return refuse(error.what());
  }
  return std::nullopt;
}

// Called after CLI11 has read arguments and environment; the config file has lower precedence.
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
  command.add_option("--robot", options.robot, "robot: a name, or a file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command
      .add_option("--workcell", options.workcell,
                  "workcell: a name, or a file (default: the one named after the robot)")
      ->type_name("NAME|FILE");
  command
      .add_option("--fault", options.fault_file,
                  "faults of the robot and its lines: a name, or a file")
      ->type_name("NAME|FILE");
}

void add_time(CLI::App& command, ServeOptions& options, const std::string& clocks) {
  add_profile(command, options.profile);
  command
      .add_option_function<std::string>(
          "--clock", [&options](const std::string& text) { options.clock = parse_clock(text); },
          clocks)
      ->type_name("real[:FACTOR]|manual|bytes[:INQUIRY_MS[,settle=MS]]")
      ->check(parses(parse_clock, ""));
  add_flag(command, "--concurrent-lines", options.has_concurrent_lines,
           "with --clock bytes: all lines are obeyed together, not one at a time");
}

void add_line_speed(CLI::App& command, ServeOptions& options) {
  command
      .add_option_function<std::string>(
          "--line-speed",
          [&options](const std::string& text) { options.line_speed = parse_line_speed(text); },
          "time that bytes of serial lines take, by these settings or those of the client")
      ->type_name("9600-7e2|auto[:FACTOR]")
      ->check(parses(parse_line_speed, ""));
}

void add_ports(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option("--listen", options.listen,
                  "address to listen on; any except loopback needs a token or --insecure")
      ->type_name("ADDR")
      ->check(CLI::Validator(check_listen, ""))
      ->capture_default_str();
  serve
      .add_option("--robot-port", options.robot_port,
                  "port of the serial lines; 0 takes a free one")
      ->type_name("PORT")
      ->check(CLI::Validator(check_port, ""))
      ->capture_default_str();
  serve
      .add_option("--monitor-port", options.monitor_port,
                  "port of the JSON monitor; 0 takes a free one")
      ->type_name("PORT")
      ->check(CLI::Validator(check_port, ""))
      ->capture_default_str();
}

void add_port_file(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option("--port-file", options.port_file,
                  "write the ports to this file as JSON when the server is ready")
      ->type_name("FILE");
}

void add_log(CLI::App& serve, ServeOptions& options) {
  serve.add_option("--log-level", options.log_level, "trace, debug, info, warn, error or off")
      ->type_name("L")
      ->check(CLI::IsMember(kLogLevels).description(""))
      ->capture_default_str();
  serve
      .add_option("--log-file", options.log_file,
                  "write the log to this file, rotated at 10 MB, at most 5 files; else to standard "
                  "error")
      ->type_name("FILE");
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
  add_names(serve, "--allow-host", options.allow_hosts, "NAME",
            "host name that browsers may use for this machine; several with commas", check_host);
  add_names(serve, "--allow-origin", options.allow_origins, "ORIGIN",
            "origin of pages that may connect, such as https://page.lab; several with commas",
            check_origin);
  add_flag(serve, "--insecure", options.is_insecure,
           "allow other machines without a token: anyone who can connect can control the robot");
}

void add_serve(CLI::App& app, ServeOptions& options) {
  CLI::App& serve = *app.add_subcommand("serve", "start a robot and its controller");
  add_machine(serve, options);
  add_ports(serve, options);
  add_cells(serve, options);
  add_time(serve, options,
           "real (default), FACTOR times as fast; manual: by the monitor; bytes: by the programs");
  serve
      .add_option("--max-lines", options.max_lines,
                  "maximum number of open robot connections; further ones are closed at once")
      ->type_name("N")
      ->check(whole_number_between(1, kMaxLines))
      ->capture_default_str();
  serve
      .add_option("--max-per-address", options.max_per_address,
                  "maximum number of connections of one address on each port")
      ->type_name("N")
      ->check(whole_number_between(1, kMaxLines));
  serve
      .add_option("--max-memory", options.max_memory_mib,
                  "MiB of memory beyond which the greediest client is disconnected")
      ->type_name("MIB")
      ->check(whole_number_between(kMinMemoryMib, kMaxMemoryMib))
      ->capture_default_str();
  serve
      .add_option_function<std::string>(
          "--guard", [&options](const std::string& text) { options.guard = parse_guard(text); },
          "which clients the robot port disconnects by their first bytes (default: normal)")
      ->type_name("strict|normal|off")
      ->check(parses(parse_guard, ""));
  add_device(serve, options);
  add_line_speed(serve, options);
  add_ptys(serve, options);
  add_port_file(serve, options);
  add_recording(serve, options);
  add_history(serve, options);
  add_log(serve, options);
  add_access(serve, options);
  add_config(serve, options.config);
  read_environment(serve, {"--token"});
  serve.parse_complete_callback([&serve, &options] { complete(serve, options); });
}

Options checked_serve(ServeOptions options) {
  const bool has_token = !std::holds_alternative<NoToken>(options.token);
  if (options.is_private && !has_token)
    return refuse(source_of(options.option_sources, "--private") +
                  " needs a token: --token-file FILE, XR3_TOKEN or --token auto");
  const bool is_safe = is_loopback(options.listen) || has_token || options.is_insecure;
  if (!is_safe) return refuse_listen(options);
  if (options.is_mirrored && !options.device)
    return refuse(source_of(options.option_sources, "--mirror") + " needs --serial DEVICE");
  if (options.device && !options.fault_file.empty())
    return refuse(source_of(options.option_sources, "--fault") +
                  " cannot be used with --serial: faults are for the simulation, not for an arm");
  if (options.device && !(options.clock == ClockChoice{}))
    return refuse(source_of(options.option_sources, "--serial") +
                  " needs --clock real: a physical arm does not run faster or wait");
  if (options.has_concurrent_lines && options.clock.mode != ClockMode::kBytes)
    return refuse(source_of(options.option_sources, "--concurrent-lines") +
                  " needs --clock bytes: with the other clocks all lines are obeyed together");
  if (options.has_concurrent_lines && options.clock.bytes.settle_ms)
    return refuse(
        source_of(options.option_sources, "--concurrent-lines") +
        " cannot be used with settle=: the silence of one line says nothing of the others");
  if (options.device && options.line_speed)
    return refuse(source_of(options.option_sources, "--line-speed") +
                  " cannot be used with --serial: the arm's port has a speed of its own");
  if (auto refused = refuse_cells(options)) return *std::move(refused);
  if (options.device && !is_loopback(options.listen) && !has_token)
    return refuse(source_of(options.option_sources, "--serial") +
                  " with --listen beyond this machine needs a token, also with --insecure");
  return options;
}

bool is_loopback(const std::string& address) {
  ErrorCode error;
  return address == "localhost" || asio::ip::make_address(address, error).is_loopback();
}

}  // namespace xr3
