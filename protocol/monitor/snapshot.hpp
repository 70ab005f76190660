// The members of a `state` message: a snapshot of the machine as JSON, with rounded numbers (mm
// with 3 decimals, degrees with 4, matrices with 5). A pure function of model and snapshot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "protocol/json/values.hpp"

namespace xr3 {

/// The physical controller behind the lines.
struct DeviceStatus {
  std::string path;
  bool is_open = false;
  bool is_engaged = false;  ///< whether commands of the lines go to the controller
  std::uint64_t bytes_out = 0;
  std::uint64_t bytes_in = 0;
  bool operator==(const DeviceStatus&) const = default;
};

/// The data of a `state` message. Equal snapshots give equal messages.
struct Snapshot {
  std::int64_t epoch = 0;  ///< see Epoch in cell_event.hpp
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  int model_rev = 1;  ///< counts the changes of the workcell since the start
  State state;
  std::optional<DeviceStatus> device;
  bool is_in_past = false;  ///< the cell was taken back, and time is stopped
  bool is_frozen = false;   ///< time is stopped for a lesson
  bool operator==(const Snapshot&) const = default;
};

/// Names of the top-level members that a client has selected; nullopt for all.
using Fields = std::optional<std::vector<std::string>>;

/// `protected_region`, `work_surface`, or JSON null.
Json stall_json(Stall stall);

/// The members of `state` that can be selected, in order.
const std::vector<std::string>& state_members();

/// The members of a `state` message except op, id, cell, epoch, seq and tick: all, or the selected
/// ones in the order of selection. Unknown names are ignored.
Json state_json(const Model& model, const Snapshot& snapshot, const Fields& fields = {});

/// Names and JSON texts of the members of a message, in order.
using MemberTexts = std::vector<std::pair<std::string, std::string>>;

/// Encodes the members of `state` repeatedly: only the blocks that have changed since the last call
/// are encoded again. The texts are those of state_json().
class StateEncoder {
 public:
  MemberTexts encode(const Model& model, const Snapshot& snapshot);

 private:
  /// The list of the blocks. A held block moves with the tool, so it is always encoded again.
  std::string blocks_text(const Model& model, const Snapshot& snapshot);

  SharedVector<Block> blocks_;      ///< blocks of the last call
  std::vector<std::string> texts_;  ///< texts of these blocks, as if none was held
};

/// The selected members, in the order of selection; unknown names are ignored.
Json chosen(const Json& members, const Fields& fields);

}  // namespace xr3
