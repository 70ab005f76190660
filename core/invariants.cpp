#include "core/invariants.hpp"

#include <cstdlib>

#include "core/carousel.hpp"
#include "core/command.hpp"
#include "core/coupling.hpp"
#include "core/faults/effects.hpp"
#include "core/faults/motor_faults.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"
#include "core/workcell_edit.hpp"

namespace xr3 {
namespace {

const char* broken_in_motor(const Model& model, const State& state, const Positions& positions,
                            int index) {
  const MotorState& motor = state.motor(index);
  const bool is_stopped = motor.error == 0 || motor.blocked != Blocked::kNo;
  if (motor.speed == 0) return "a motor's speed is at least 1 count a second";
  if (motor.phase < 0 || motor.phase >= kPhasePerCount) return "a motor's phase is within 0...999";
  if (is_stopped && motor.phase != 0) return "the phase of a stopped motor is 0";
  const Blocked expected =
      motor.error == 0 ? Blocked::kNo : obstacle(model, state, positions, index);
  if (motor.blocked != expected) return "a motor is blocked exactly where something obstructs it";
  const bool is_at_switch = is_closed(model.motor(index), motor.count);
  if (motor.switch_closed != with_stuck_switch(state, index, is_at_switch))
    return "a microswitch follows from its motor's count, unless it is stuck";
  return nullptr;
}

const char* broken_in_limits(const Model& model, const Positions& positions) {
  for (int i = 0; i < model.motor_count(); ++i) {
    if (model.motor(i).excess(positions[static_cast<std::size_t>(i)]) > 0)
      return "every joint is within its limits";
  }
  return nullptr;
}

const char* broken_in_grasp(const Model& model, const State& state) {
  if (!state.held) return nullptr;
  if (state.held->block >= state.blocks.size()) return "the held block exists";
  const Block at_grasp = as_released(model, state, *state.held, state.held->grasped_at);
  if (!(state.blocks[state.held->block] == at_grasp))
    return "a held block's entry is where it was grasped";
  return nullptr;
}

const char* broken_in_riders(const Model& model, const State& state) {
  if (!model.carousel()) return state.riders.empty() ? nullptr : "blocks ride on a carousel only";
  std::uint32_t next = 0;
  for (const Rider& rider : state.riders) {
    if (rider.block < next || rider.block >= state.blocks.size())
      return "riders are blocks, in their order";
    if (is_held(state, rider.block)) return "a held block does not ride";
    if (!(state.blocks[rider.block] == as_turned(model, state, rider)))
      return "a block on the carousel is where its count puts it";
    next = rider.block + 1;
  }
  return nullptr;
}

const char* broken_in_faults(const Model& model, const State& state) {
  if (state.faults.all.empty()) {
    return state.faults.now == FaultsInForce{} ? nullptr : "without faults none is in force";
  }
  if (state.faults.all.size() > kMaxFaults) return "the number of faults is bounded";
  State again;
  again.tick = state.tick;
  again.faults = state.faults;
  refresh_faults(model, again);
  return again.faults == state.faults
             ? nullptr
             : "the faults in force follow from the tick and their effects";
}

bool is_component(int value) { return std::abs(value) <= SetViewVector::kMax; }

const char* broken_in_display(const DisplaySettings& display) {
  const ViewVector& view = display.view;
  if (!is_component(view.x) || !is_component(view.y) || !is_component(view.z))
    return "the view vector's components are within -9...9";
  if (view == ViewVector{0, 0, 0}) return "the view vector is not zero";
  if (display.period_half_s < SetRefreshPeriod::kMin ||
      display.period_half_s > SetRefreshPeriod::kMax)
    return "the refresh period is within 1...255 half seconds";
  if (display.status_option < 0 || display.status_option > SelectStatus::kMax)
    return "the status option is within 0...6";
  return nullptr;
}

const char* broken_in_path(const TipPath& path) {
  if (path.points.size() > TipPath::kMaxTipPoints) return "the tip path is bounded";
  if (path.oldest != 0 && path.oldest >= path.points.size())
    return "the tip path's oldest point exists";
  return nullptr;
}

}  // namespace

const char* broken_invariant(const Model& model, const State& state) {
  const Positions now = positions(model, state.motors);
  for (int i = 0; i < model.motor_count(); ++i) {
    if (const char* broken = broken_in_motor(model, state, now, i)) return broken;
  }
  if (state.blocks.size() > kMaxBlocks) return "the number of blocks is bounded";
  if (state.below_surface != is_below_surface(model, tool_tip(model, now)))
    return "the tip is below the surface exactly where the state says so";
  if (const char* broken = broken_in_limits(model, now)) return broken;
  if (const char* broken = broken_in_grasp(model, state)) return broken;
  if (const char* broken = broken_in_riders(model, state)) return broken;
  if (const char* broken = broken_in_faults(model, state)) return broken;
  if (const char* broken = broken_in_display(state.display)) return broken;
  return broken_in_path(state.tip_path);
}

}  // namespace xr3
