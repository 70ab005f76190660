// Helpers for the tests of inverse kinematics: the three robots by name, and the distance between
// two sets of joint variables.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "core/inverse/inverse.hpp"
#include "tests/support/rig.hpp"

namespace xr3::test {

inline constexpr const char* kRhino = "rhino-xr3";
inline constexpr const char* kAdept = "adept-one";
inline constexpr const char* kIntelledex = "intelledex-660";

inline const ModelPtr& model_named(const std::string& name) {
  static const ModelPtr rhino = model_of(robot_named("rhino-xr3"));
  static const ModelPtr adept = model_of(robot_named("adept-one"));
  static const ModelPtr intelledex = model_of(robot_named("intelledex-660"));
  return name == "adept-one" ? adept : name == "intelledex-660" ? intelledex : rhino;
}

inline Positions motors_at(const Model& model, std::initializer_list<LabelledCount> counts) {
  Positions motors{};
  for (const auto& [label, count] : counts) {
    motors[static_cast<std::size_t>(model.index_of(label))] = count;
  }
  return motors;
}

inline double apart_deg(double one, double other) {
  return std::abs(std::remainder(one - other, 360.0));
}

/// The maximum difference of a joint, modulo full turns.
inline double apart(const Model& model, const JointVariables& one, const JointVariables& other) {
  double most = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const bool turns = model.robot().joints[k].variable == JointVariable::kTheta;
    most = std::max(most, turns ? apart_deg(one[k], other[k]) : std::abs(one[k] - other[k]));
  }
  return most;
}

inline const InverseSolution* nearest_to(const Model& model, const InverseResult& result,
                                         const JointVariables& variables) {
  const auto nearest = std::min_element(
      result.solutions.begin(), result.solutions.end(), [&](const auto& one, const auto& other) {
        return apart(model, one.variables, variables) < apart(model, other.variables, variables);
      });
  return nearest == result.solutions.end() ? nullptr : &*nearest;
}

}  // namespace xr3::test
