#include "cli/options/replay.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <utility>

#include "cli/options/options.hpp"
#include "cli/options/shared_options.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/text/whole_number.hpp"

namespace xr3 {
namespace {

ReplayPrint print_named(const std::string& name) {
  return name == "state" ? ReplayPrint::kState : ReplayPrint::kStatus;
}

}  // namespace

ReplayTime parse_replay_time(const std::string& text) {
  const std::size_t colon = text.find(':');
  const bool has_epoch = colon != std::string::npos;
  const std::string_view all = text;
  const auto number = [](std::string_view part) {
    return whole_number<std::int64_t>(part, 0, monitor::kMaxInteger);
  };
  const auto epoch = has_epoch ? number(all.substr(0, colon)) : 0;
  const auto tick = number(has_epoch ? all.substr(colon + 1) : all);
  if (epoch && tick) return {*epoch, *tick};
  throw std::invalid_argument(text + ": a time is a tick, or epoch and tick as in 1:5000");
}

void add_replay(CLI::App& app, ReplayOptions& options, ServeOptions& server) {
  CLI::App& replay = *app.add_subcommand(
      "replay", "repeat what xr3 serve --record has recorded, and compare every reply");
  add_value(replay, "file", options.file, "FILE", "the recording")->required();
  add_parsed(replay, "--until", options.until, parse_replay_time, "[EPOCH:]TICK",
             "stop at this tick (of epoch 0 unless another is given)");
  replay
      .add_option_function<std::string>(
          "--print", [&options](const std::string& what) { options.print = print_named(what); },
          "state: the monitor's state message at the end; status: the controller's status line")
      ->type_name("state|status")
      ->check(CLI::IsMember({"state", "status"}).description(""));
  add_value(replay, "--svg", options.svg, "OUT.svg", "draw the end as a picture");
  CLI::Option* csv = add_value(replay, "--csv", options.csv, "OUT.csv",
                               "write joints, counts and tip over time as a table");
  add_value(replay, "--every", options.every_ms, "MS", "with --csv: simulated ms between two lines")
      ->check(whole_number_between(1, kMaxEveryMs))
      ->needs(csv)
      ->capture_default_str();
  CLI::Option* serve = replay.add_flag(
      "--serve", options.is_serving, "go on as a server from the end, with these options of serve");
  add_ports(replay, server);
  add_port_file(replay, server);
  add_log(replay, server);
  add_access(replay, server);
  for (const char* name :
       {"--listen", "--robot-port", "--monitor-port", "--port-file", "--log-level", "--log-file",
        "--token-file", "--token", "--private", "--metrics-token-file", "--allow-host",
        "--allow-origin", "--allow-frame", "--insecure"})
    replay.get_option(name)->needs(serve);
}

}  // namespace xr3
