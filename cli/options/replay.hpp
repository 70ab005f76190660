// The command line of `xr3 replay`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cell/recording/replayer.hpp"
#include "cli/options/cli_fwd.hpp"

namespace xr3 {

struct ServeOptions;

/// Simulated time between two samples of a recording.
inline constexpr int kUsualEveryMs = 100;
inline constexpr int kMaxEveryMs = 3'600'000;

/// The part of the state at the end that is printed.
enum class ReplayPrint : std::uint8_t {
  kNothing,
  kState,   ///< the monitor's `state` message, on one line
  kStatus,  ///< the controller's status line
};

struct ReplayOptions {
  std::string file;
  std::optional<ReplayTime> until;
  ReplayPrint print = ReplayPrint::kNothing;
  std::string svg;               ///< a picture of the end; empty for none
  std::string csv;               ///< a table of joints over time; empty for none
  int every_ms = kUsualEveryMs;  ///< simulated time between its lines
  bool is_serving = false;
};

/// Adds the subcommand `replay` with its options; `server` has those of serving after it.
void add_replay(CLI::App& app, ReplayOptions& options, ServeOptions& server);

/// Parses `TICK` or `EPOCH:TICK`. Throws std::invalid_argument, with the allowed form.
ReplayTime parse_replay_time(const std::string& text);

}  // namespace xr3
