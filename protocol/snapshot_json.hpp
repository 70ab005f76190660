// The `state` message's members: one look at the machine as JSON, rounded for people and programs
// (mm to 3 decimals, degrees to 4, matrices to 5). A pure function of model and snapshot; it knows
// no clients and no sequence numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// Everything that a `state` message shows, as a value. Equal snapshots are shown alike.
struct Snapshot {
  std::int64_t epoch = 0;  ///< counts the states that are not a continuation of one another
  ClockMode mode = ClockMode::kReal;
  Rate rate;
  int model_rev = 1;  ///< counts the workcells since the start
  State state;
  bool operator==(const Snapshot&) const = default;
};

/// Decimals of the monitor's numbers.
inline constexpr int kMmDecimals = 3;
inline constexpr int kDegreeDecimals = 4;
inline constexpr int kMatrixDecimals = 5;

/// Names of top-level members that a client chose; none: all of them.
using Fields = std::optional<std::vector<std::string>>;

/// The members of `state` that may be chosen, in their order.
const std::vector<std::string>& state_members();

/// `{"mode":"real","rate":1.0}`; the rate is simulated seconds in a wall second.
Json clock_json(ClockMode mode, Rate rate);

/// Every member of a `state` message but op, id, cell, epoch, seq and tick.
Json state_json(const Model& model, const Snapshot& snapshot);

/// The chosen members in the order in which they were chosen; names without a member are left out.
Json chosen(const Json& members, const Fields& fields);

/// A point as the monitor shows it: `[250.0,60.0,15.0]` in mm.
Json point_json(const PointUm& point);

/// To so many decimals, 0...9, and never -0. JSON has no infinity: it becomes the greatest number.
double rounded(double value, int decimals);

}  // namespace xr3
