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
};

/// The summary of a machine in this state; name, robot port, lines, peer, owner, recording, last
/// input and epoch remain to be filled in.
CellSummary machine_summary(const Model& model, const State& state);

/// The object of a cell, with all members.
Json summary_json(const CellSummary& cell);

/// Whether two objects differ in more than their tick.
bool is_news(const CellSummary& before, const CellSummary& now);

/// A message of the channel. `cells` are the texts of their objects. `is_whole`: the client must
/// discard all cells of earlier messages.
Message overview_message(std::int64_t seq, bool is_whole, const std::vector<std::string>& cells,
                         const std::vector<std::string>& closed);

}  // namespace xr3::monitor
