#include "tests/support/rig.hpp"

#include <algorithm>

#include "core/carousel.hpp"
#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"

namespace xr3::test {
namespace {

constexpr Tick kMaxRunTicks = 128'000;
constexpr Counts kPiece = 100;

}  // namespace

State state_at(const Model& model, std::initializer_list<LabelledCount> counts) {
  State state = initial_state(model);
  for (const auto& [label, count] : counts) state.motor(model.index_of(label)).count = count;
  Events unheard;
  if (model.carousel()) carry_riders(model, state);
  update_switches(model, state, unheard);
  update_surface(model, state, tool_tip(model, positions(model, state.motors)), unheard);
  return state;
}

Positions positions_at(const Model& model, std::initializer_list<LabelledCount> counts) {
  return positions(model, state_at(model, counts).motors);
}

Counts Rig::position(char label) const {
  return xr3::position(model(), state().motors, model().index_of(label));
}

void Rig::stand_at(std::initializer_list<LabelledCount> counts) {
  simulation.restore(state_at(model(), counts));
  simulation.take_events();
}

void Rig::travel(char label, Counts counts) {
  while (counts != 0) {
    const Counts piece = std::clamp(counts, -kPiece, kPiece);
    move(label, piece);
    settle();
    counts -= piece;
  }
}

void Rig::settle() { simulation.run_to_rest(simulation.tick() + kMaxRunTicks); }

}  // namespace xr3::test
