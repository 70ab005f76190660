// The channel `overview`: one small object for each cell of the server, sent again when it has
// changed, and the names of the cells that have closed. Independent of cells and connections.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/subscription.hpp"

namespace xr3::monitor {

/// Milliseconds since 1970 in UTC.
using UnixMs = std::int64_t;

/// The last command of the lines.
struct CommandSummary {
  std::string text;         ///< as it was sent, or its code if it is long
  std::uint64_t count = 0;  ///< number of equal commands in a row
  bool has_reply = false;   ///< an inquiry
  bool operator==(const CommandSummary&) const = default;
};

/// The last warning of the controller or the workcell.
struct WarningSummary {
  std::string text;
  UnixMs at = 0;
  std::uint64_t count = 0;  ///< number of warnings with the same code in a row
  bool operator==(const WarningSummary&) const = default;
};

/// The points of the goals that are met now, and of all.
struct PointsSummary {
  int met = 0;
  int most = 0;
  bool operator==(const PointsSummary&) const = default;
};

/// The summary of a cell in the overview.
struct CellSummary {
  std::string name;
  std::string robot;                ///< name of the robot
  std::optional<int> robot_port;    ///< nullopt if the cell has no port of its own
  std::size_t lines = 0;            ///< open lines
  std::optional<std::string> peer;  ///< peer of the line opened last; nullopt without a line
  /// Owner of the robot port (--bind-peer); nullopt if there is none.
  std::optional<std::string> owner;
  bool is_moving = false;
  Stall stall = Stall::kNo;
  std::optional<std::string> holding;   ///< name of the block
  bool has_recording_failed = false;    ///< a recording was started and has ended early
  std::optional<Tick> last_input_tick;  ///< nullopt if no byte has arrived in this epoch
  std::int64_t epoch = 0;
  Tick tick = 0;
  std::vector<double> joints;  ///< joint variables from base to tip, then the carousel's, deg or mm
  double tool = 0;             ///< tool variable, deg or mm
  bool is_paused = false;
  bool is_frozen = false;
  bool is_coming_back = false;          ///< the recording is repeated first
  std::size_t viewers = 0;              ///< monitor clients that follow a channel of the cell
  std::optional<UnixMs> last_input_at;  ///< nullopt if no byte has arrived on a line
  std::optional<CommandSummary> last_command;
  std::optional<UnixMs> stalled_at;  ///< nullopt unless it is stalled
  std::optional<WarningSummary> last_warning;
  std::optional<std::vector<bool>> goals;  ///< met now, by goal; nullopt without goals
  std::optional<PointsSummary> points;     ///< nullopt without goals
};

/// The summary of a machine in this state; other members remain to be filled in.
CellSummary machine_summary(const Model& model, const State& state);

/// The object of a cell, with all members.
Json summary_json(const CellSummary& cell);

/// Whether two objects differ in more than their tick.
bool is_news(const CellSummary& before, const CellSummary& now);

/// A message of the channel, made at `now`. `cells` are the texts of their objects. `is_whole`: the
/// client must discard all cells of earlier messages.
Message overview_message(std::int64_t seq, UnixMs now, bool is_whole,
                         const std::vector<std::string>& cells,
                         const std::vector<std::string>& closed);

}  // namespace xr3::monitor
