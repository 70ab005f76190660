// A simulation for tests, with access to motors by label and helpers for frequent operations.
#pragma once

#include <initializer_list>
#include <utility>
#include <variant>
#include <vector>

#include "core/coupling.hpp"
#include "core/simulation.hpp"
#include "tests/support/models.hpp"
#include "tests/support/words.hpp"

namespace xr3::test {

/// A motor, by label, and its count.
using LabelledCount = std::pair<char, Counts>;

/// The soft home with other counts for these motors; switches and the side of the work surface are
/// updated.
State state_at(const Model& model, std::initializer_list<LabelledCount> counts);

/// Positions if these motors are at these counts and all others at 0.
Positions positions_at(const Model& model, std::initializer_list<LabelledCount> counts);

class Rig {
 public:
  explicit Rig(ModelPtr model = rhino()) : simulation(std::move(model)) {}

  Simulation simulation;

  const Model& model() const { return simulation.model(); }
  const State& state() const { return simulation.state(); }
  const MotorState& motor(char label) const { return state().motor(model().index_of(label)); }
  Counts count(char label) const { return motor(label).count; }
  int error(char label) const { return motor(label).error; }
  Counts position(char label) const;

  /// Restarts with the motors at these counts.
  void stand_at(std::initializer_list<LabelledCount> counts);
  Reply execute(const Command& command) { return simulation.execute(command); }
  void move(char label, int counts) { execute(Move{label, counts}); }
  void pass(Tick ticks) { simulation.advance_to(simulation.tick() + ticks); }
  /// Moves by any number of counts, in pieces that fit the 8-bit counter, and waits for each.
  void travel(char label, Counts counts);
  /// Runs until the machine is at rest; at most 128 s, the maximum that an 8-bit counter can keep a
  /// motor running.
  void settle();

  /// The bodies of the pending events of one kind, in order.
  template <class Body>
  std::vector<Body> events_of() const {
    std::vector<Body> bodies;
    for (const Event& event : simulation.events()) {
      if (const Body* body = std::get_if<Body>(&event.body)) bodies.push_back(*body);
    }
    return bodies;
  }
};

/// The ticks of the events of one kind.
template <class Body>
std::vector<Tick> ticks_of(const Events& events) {
  std::vector<Tick> ticks;
  for (const Event& event : events) {
    if (std::holds_alternative<Body>(event.body)) ticks.push_back(event.tick);
  }
  return ticks;
}

}  // namespace xr3::test
