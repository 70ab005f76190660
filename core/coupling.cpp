#include "core/coupling.hpp"

namespace xr3 {

Counts position(const Model& model, const Motors& motors, int index) {
  Counts sum = 0;
  for (int motor = 0; motor < model.motor_count(); ++motor) {
    sum += model.gain(index, motor) * motors[static_cast<std::size_t>(motor)].count;
  }
  return sum;
}

Positions positions(const Model& model, const Motors& motors) {
  Positions result{};
  for (int i = 0; i < model.motor_count(); ++i) {
    turn(model, result, i, motors[static_cast<std::size_t>(i)].count);
  }
  return result;
}

void turn(const Model& model, Positions& positions, int motor, Counts counts) {
  for (const CoupledJoint& driven : model.driven_by(motor))
    positions[driven.joint] += driven.gain * counts;
}

Positions motor_counts(const Model& model, const Positions& wanted) {
  Positions counts{};
  const int n = model.motor_count();
  // Couplings of real arms run from the base outwards, so one pass in that order suffices. Files
  // that couple in the other direction need more passes; n always suffice.
  for (int pass = 0; pass < n; ++pass) {
    for (int i = 0; i < n; ++i) {
      Counts added = 0;
      for (int j = 0; j < n; ++j) {
        if (j != i) added += model.gain(i, j) * counts[static_cast<std::size_t>(j)];
      }
      counts[static_cast<std::size_t>(i)] = wanted[static_cast<std::size_t>(i)] - added;
    }
  }
  return counts;
}

}  // namespace xr3
