#include "server/options/replay.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "protocol/monitor/request.hpp"
#include "server/options/options.hpp"
#include "server/options/shared_options.hpp"

namespace xr3 {
namespace {

constexpr int kMaxEveryMs = 3'600'000;

std::int64_t whole(std::string_view text) {
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole && number <= monitor::kMaxInteger ? number : -1;
}

ReplayPrint print_named(const std::string& name) {
  return name == "state" ? ReplayPrint::kState : ReplayPrint::kStatus;
}

}  // namespace

ReplayTime parse_replay_time(const std::string& text) {
  const std::size_t colon = text.find(':');
  const bool has_epoch = colon != std::string::npos;
  const std::string_view all = text;
  const ReplayTime time{has_epoch ? whole(all.substr(0, colon)) : 0,
                        whole(has_epoch ? all.substr(colon + 1) : all)};
  if (time.epoch >= 0 && time.tick >= 0) return time;
  throw std::invalid_argument(text + ": a time is a tick, or epoch and tick as in 1:5000");
}

void add_replay(CLI::App& app, ReplayOptions& options, ServeOptions& server) {
  CLI::App& replay = *app.add_subcommand(
      "replay", "repeat what xr3 serve --record has recorded, and compare every reply");
  replay.add_option("file", options.file, "the recording")->type_name("FILE")->required();
  replay
      .add_option_function<std::string>(
          "--until",
          [&options](const std::string& text) { options.until = parse_replay_time(text); },
          "stop at this tick (of epoch 0 unless another is given)")
      ->type_name("[EPOCH:]TICK")
      ->check(parses(parse_replay_time, ""));
  replay
      .add_option_function<std::string>(
          "--print", [&options](const std::string& what) { options.print = print_named(what); },
          "state: the monitor's state message at the end; status: the controller's status line")
      ->type_name("state|status")
      ->check(CLI::IsMember({"state", "status"}).description(""));
  replay.add_option("--svg", options.svg, "draw the end as a picture")->type_name("OUT.svg");
  CLI::Option* csv =
      replay.add_option("--csv", options.csv, "write joints, counts and tip over time as a table")
          ->type_name("OUT.csv");
  replay.add_option("--every", options.every_ms, "with --csv: simulated ms between two lines")
      ->type_name("MS")
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
        "--token-file", "--token", "--private", "--allow-host", "--allow-origin", "--insecure"})
    replay.get_option(name)->needs(serve);
}

}  // namespace xr3
