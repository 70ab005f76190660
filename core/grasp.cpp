#include "core/grasp.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/carousel.hpp"
#include "core/placement.hpp"

namespace xr3 {
namespace {

constexpr double kQuarter = 90.0;

Micrometres opening_um(const Model& model, Counts tool_position) {
  return micrometres(opening_mm(model, tool_position));
}

// The height comes first: it is without a sine, and it rules most blocks out.
bool contains(const Block& block, const PointUm& tip) {
  if (2 * std::abs(tip.z - block.centroid_um.z) > block.size_um.z) return false;
  const auto [sin, cos] = sin_cos_deg(degrees(block.yaw_udeg));
  const auto dx = static_cast<double>(tip.x - block.centroid_um.x) / kMicrometresPerMm;
  const auto dy = static_cast<double>(tip.y - block.centroid_um.y) / kMicrometresPerMm;
  return 2 * std::abs(micrometres(cos * dx + sin * dy)) <= block.size_um.x &&
         2 * std::abs(micrometres(cos * dy - sin * dx)) <= block.size_um.y;
}

Micrometres squared_distance(const PointUm& a, const PointUm& b) {
  const Micrometres x = a.x - b.x;
  const Micrometres y = a.y - b.y;
  const Micrometres z = a.z - b.z;
  return x * x + y * y + z * z;
}

/// The block that contains the tip. Of several: the one with the nearest centroid, then the first.
std::optional<std::uint32_t> block_at(const State& state, const PointUm& tip) {
  std::optional<std::uint32_t> nearest;
  for (std::uint32_t i = 0; i < state.blocks.size(); ++i) {
    if (!contains(state.blocks[i], tip)) continue;
    const bool is_nearer =
        !nearest || squared_distance(state.blocks[i].centroid_um, tip) <
                        squared_distance(state.blocks[*nearest].centroid_um, tip);
    if (is_nearer) nearest = i;
  }
  return nearest;
}

/// The extents of a block between the jaws.
struct JawExtents {
  Micrometres extent_um;  ///< opening that it needs as it lies, and while it turns flat
  Micrometres flat_um;    ///< opening that it needs once its sides lie flat against the fingers
  int quarter_turns;
};

JawExtents extents_of(const Block& block, double net_roll) {
  const double delta = degrees(block.yaw_udeg) - net_roll;
  const auto [sin, cos] = sin_cos_deg(delta);
  const double extent = mm(block.size_um.y) * std::abs(cos) + mm(block.size_um.x) * std::abs(sin);
  const auto quarters = static_cast<int>(std::floor(delta / kQuarter + 0.5));
  const Micrometres flat = flat_extent_um(block, quarters);
  // A slender block that turns onto its length needs more room flat than as it lies.
  return {std::max(micrometres(extent), flat), flat, quarters & 3};
}

Microdegrees flat_yaw(double net_roll, int quarter_turns) {
  return normalized(microdegrees(net_roll + kQuarter * quarter_turns));
}

}  // namespace

Transform lying_pose(const Block& block) {
  const auto [sin, cos] = sin_cos_deg(degrees(block.yaw_udeg));
  Transform upright = Transform::Identity();
  upright(0, 0) = cos;
  upright(0, 1) = -sin;
  upright(1, 0) = sin;
  upright(1, 1) = cos;
  upright.block<3, 1>(0, 3) << mm(block.centroid_um.x), mm(block.centroid_um.y),
      mm(block.centroid_um.z);
  return upright;
}

Transform block_pose(const Model& model, const State& state, std::size_t index) {
  Transform upright = lying_pose(state.blocks[index]);
  if (!state.held || state.held->block != index) return upright;
  const Transform grasped = tool_transform(model, state.held->grasped_at);
  Transform now = tool_transform(model, positions(model, state.motors));
  now.block<3, 3>(0, 0) *= grasped.block<3, 3>(0, 0).transpose() * upright.block<3, 3>(0, 0);
  return now;
}

bool opens_jaws(const Model& model, int direction) {
  return direction * model.motor(model.tool_index()).drive.direction > 0;
}

JawContact next_closing(const Model& model, const State& state, const Positions& positions) {
  using Kind = JawContact::Kind;
  const Counts now = positions[static_cast<std::size_t>(model.tool_index())];
  const Counts next = now - model.motor(model.tool_index()).drive.direction;
  const auto index = block_at(state, tool_tip(model, positions));
  if (!index) return {};
  const JawExtents extents = extents_of(state.blocks[*index], net_roll_deg(model, positions));
  const Micrometres next_opening = opening_um(model, next);
  const JawContact contact{Kind::kFree, *index, extents.quarter_turns};
  if (opening_um(model, now) < extents.extent_um)
    return {Kind::kTooNarrow, contact.block, contact.quarter_turns};
  if (next_opening < extents.flat_um) return {Kind::kHolds, contact.block, contact.quarter_turns};
  if (next_opening < extents.extent_um) return {Kind::kTurns, contact.block, contact.quarter_turns};
  return contact;
}

Block as_released(const Model& model, const State& state, const Held& held,
                  const Positions& positions) {
  Block block = state.blocks[held.block];
  block.centroid_um = tool_tip(model, positions);
  block.yaw_udeg = flat_yaw(net_roll_deg(model, positions), held.quarter_turns);
  return block;
}

Micrometres flat_extent_um(const Block& block, int quarter_turns) {
  return quarter_turns % 2 == 0 ? block.size_um.y : block.size_um.x;
}

bool can_hold(const Model& model, const Block& block, const Held& held) {
  const MotorModel& tool = model.motor(model.tool_index());
  const Counts now = held.grasped_at[static_cast<std::size_t>(model.tool_index())];
  const Counts next = now - tool.drive.direction;
  const Micrometres flat = flat_extent_um(block, held.quarter_turns);
  return tool.excess(next) == 0 && opening_um(model, next) < flat && flat <= opening_um(model, now);
}

void release(const Model& model, State& state, const Positions& positions, Events& events) {
  if (!state.held) return;
  const std::uint32_t index = state.held->block;
  Block& block = state.blocks.edit()[index];
  block = as_released(model, state, *state.held, positions);
  state.held.reset();
  find_riders(model, state);
  events.push_back({state.tick, Released{block.name, block.centroid_um, block.yaw_udeg}});
  warn_of_placement(model, state, index, events);
}

bool drop(const Model& model, State& state, const Positions& positions, Events& events) {
  assert(state.held);
  const Held held = *state.held;
  Block& block = state.blocks.edit()[held.block];
  const Block at_grasp = std::exchange(block, as_released(model, state, held, positions));
  state.held.reset();
  const Micrometres height_um = height_above_support_um(model, state, held.block);
  if (2 * height_um <= block.size_um.z) {
    block = at_grasp;
    state.held = held;
    return false;
  }
  block.centroid_um.z -= height_um;
  find_riders(model, state);
  events.push_back({state.tick, Released{block.name, block.centroid_um, block.yaw_udeg}});
  return true;
}

void warn_of_touch(const Model& model, const State& state, const Positions& positions,
                   Events& events) {
  const JawContact next = next_closing(model, state, positions);
  if (next.kind != JawContact::Kind::kHolds) return;
  const std::string& name = state.blocks[next.block].name;
  events.push_back({state.tick, Warning{WarningCode::kJawsTouch, 'A', 0, 0, name}});
}

void update_grasp(const Model& model, State& state, const Positions& positions,
                  const JawContact& contact, bool opened, Events& events) {
  using Kind = JawContact::Kind;
  if (opened) state.jaws_warned = false;
  if (opened && state.held) return release(model, state, positions, events);
  if (contact.kind == Kind::kFree) return;
  if (contact.kind == Kind::kTooNarrow) {
    if (!state.jaws_warned) {
      const std::string& name = state.blocks[contact.block].name;
      events.push_back({state.tick, Warning{WarningCode::kJawsTooNarrow, 'A', 0, 0, name}});
    }
    state.jaws_warned = true;
    return;
  }
  Block& block = state.blocks.edit()[contact.block];
  block.yaw_udeg = flat_yaw(net_roll_deg(model, positions), contact.quarter_turns);
  if (contact.kind == Kind::kTurns) return find_riders(model, state);
  block.centroid_um = tool_tip(model, positions);
  state.held = Held{contact.block, contact.quarter_turns, positions};
  find_riders(model, state);
  events.push_back({state.tick, Grasped{block.name, block.centroid_um, block.yaw_udeg}});
}

}  // namespace xr3
