// The members of a `state` message: a snapshot of the machine as JSON, with rounded numbers (mm
// with 3 decimals, degrees with 4, matrices with 5). A pure function of model and snapshot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "protocol/json/values.hpp"

namespace xr3 {

/// The data of a `state` message. Equal snapshots give equal messages.
struct Snapshot {
  std::int64_t epoch = 0;  ///< see Epoch in cell_event.hpp
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  int model_rev = 1;  ///< counts the changes of the workcell since the start
  State state;
  bool operator==(const Snapshot&) const = default;
};

/// Names of the top-level members that a client has selected; nullopt: all members.
using Fields = std::optional<std::vector<std::string>>;

/// The members of `state` that can be selected, in order.
const std::vector<std::string>& state_members();

/// All members of a `state` message except op, id, cell, epoch, seq and tick.
Json state_json(const Model& model, const Snapshot& snapshot);

/// The selected members, in the order of selection; unknown names are ignored.
Json chosen(const Json& members, const Fields& fields);

}  // namespace xr3
