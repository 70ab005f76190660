// Statistics of a cell, its ports and their clients since the start of the server, for /metrics.
// All are monotonic counters, except those marked "now", the limits and the delay of the event
// loop.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <variant>

#include "core/command.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {

inline constexpr std::size_t kCommandKinds = std::variant_size_v<Command>;
using monitor::kChannels;

/// Frames of a latest-wins channel, or messages of a ring, over all clients.
struct ChannelCounters {
  std::uint64_t sent = 0;
  std::uint64_t overwritten = 0;  ///< before they were sent: in a client's slot, or in the ring
  bool operator==(const ChannelCounters&) const = default;
};

/// Connections that a port did not serve.
struct PortCounters {
  std::uint64_t refused = 0;          ///< beyond the maximum number
  std::uint64_t accept_failures = 0;  ///< attempts that failed, such as without descriptors
  std::uint64_t other_peers = 0;      ///< closed since another address has the port

  PortCounters& operator+=(const PortCounters& more) {
    refused += more.refused;
    accept_failures += more.accept_failures;
    other_peers += more.other_peers;
    return *this;
  }
  bool operator==(const PortCounters&) const = default;
};

struct CellCounters {
  std::uint64_t lines_open = 0;  ///< now
  std::uint64_t lines_total = 0;
  std::array<std::uint64_t, kLineCloseReasons> lines_closed{};  ///< by LineCloseReason
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::array<std::uint64_t, kCommandKinds> commands{};  ///< by index in Command
  std::map<std::string_view, std::uint64_t> warnings;   ///< by code
  std::uint64_t ticks = 0;                              ///< simulated, over all epochs
  std::uint64_t recordings_failed = 0;                  ///< those that ended before their cells
  std::array<ChannelCounters, kChannels> channels{};    ///< by monitor::Channel
  std::uint64_t monitor_sessions = 0;                   ///< monitor clients now
  std::uint64_t wrong_tokens = 0;                       ///< of monitor clients
  PortCounters robot_port;
  PortCounters monitor_port;
  std::uint64_t cells_open = 0;  ///< now
  std::uint64_t cells_total = 0;
  std::uint64_t lines_max = 0;
  std::uint64_t allocated_bytes = 0;  ///< now
  std::uint64_t allocated_max = 0;
  std::optional<std::uint64_t> recording_room;  ///< bytes now; nullopt if nothing is recorded
  std::int64_t loop_lag_ns = 0;  ///< the greatest of the last minute, see server/net/loop_lag

  /// Adds the counts of a cell: of its lines, commands, warnings, ticks and recordings.
  CellCounters& operator+=(const CellCounters& cell) {
    lines_total += cell.lines_total;
    for (std::size_t i = 0; i < lines_closed.size(); ++i) lines_closed[i] += cell.lines_closed[i];
    bytes_in += cell.bytes_in;
    bytes_out += cell.bytes_out;
    for (std::size_t i = 0; i < commands.size(); ++i) commands[i] += cell.commands[i];
    for (const auto& [code, count] : cell.warnings) warnings[code] += count;
    ticks += cell.ticks;
    recordings_failed += cell.recordings_failed;
    return *this;
  }

  std::uint64_t& of(const Command& command) { return commands[command.index()]; }
  std::uint64_t& of(LineCloseReason reason) {
    return lines_closed[static_cast<std::size_t>(reason)];
  }
  ChannelCounters& of(monitor::Channel channel) {
    return channels[static_cast<std::size_t>(channel)];
  }
  bool operator==(const CellCounters&) const = default;
};

}  // namespace xr3
