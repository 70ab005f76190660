#include "core/kinematics.hpp"

#include <cmath>

namespace xr3 {
namespace {

Counts at(const Positions& positions, int index) {
  return positions[static_cast<std::size_t>(index)];
}

}  // namespace

Transform link_transform(const Model& model, int joint, Counts position) {
  const SinCos theta = model.theta(joint, position);
  const SinCos& alpha = model.twist(joint);
  const double d = model.link_offset_mm(joint, position);
  const double a = model.link_length_mm(joint);
  Transform t;
  t << theta.cos, -alpha.cos * theta.sin, alpha.sin * theta.sin, a * theta.cos,  //
      theta.sin, alpha.cos * theta.cos, -alpha.sin * theta.cos, a * theta.sin,   //
      0.0, alpha.sin, alpha.cos, d,                                              //
      0.0, 0.0, 0.0, 1.0;
  return t;
}

std::vector<Transform> base_transforms(const Model& model, const Positions& positions) {
  std::vector<Transform> chain{Transform::Identity()};
  for (int k = 0; k < model.joint_count(); ++k) {
    chain.push_back(chain.back() * link_transform(model, k, at(positions, k)));
  }
  return chain;
}

Transform tool_transform(const Model& model, const Positions& positions) {
  Transform pose = Transform::Identity();
  for (int k = 0; k < model.joint_count(); ++k) pose *= link_transform(model, k, at(positions, k));
  return pose;
}

// Transforms a point, from the tip inwards, instead of multiplying matrices: a dozen
// multiplications per joint. A point on the joint's own axis, as the tip is for the roll, needs no
// rotation.
PointUm tool_tip(const Model& model, const Positions& positions) {
  double x = 0;
  double y = 0;
  double z = 0;
  for (int k = model.joint_count() - 1; k >= 0; --k) {
    const Counts position = at(positions, k);
    const SinCos& alpha = model.twist(k);
    const double along = x + model.link_length_mm(k);
    const double across = alpha.cos * y - alpha.sin * z;
    z = alpha.sin * y + alpha.cos * z + model.link_offset_mm(k, position);
    const bool on_axis = along == 0.0 && across == 0.0;
    const SinCos theta = on_axis ? SinCos{} : model.theta(k, position);
    x = theta.cos * along - theta.sin * across;
    y = theta.sin * along + theta.cos * across;
  }
  return {micrometres(x), micrometres(y), micrometres(z)};
}

ToolConfiguration tool_configuration(const Model& model, const Positions& positions) {
  const Transform pose = tool_transform(model, positions);
  const int last = model.joint_count() - 1;
  const bool turns = model.robot().joints.back().is_revolute();
  const double variable = model.variable(last, at(positions, last));
  const double q = turns ? variable * kPi / 180.0 : variable;
  ToolConfiguration w;
  w << pose.block<3, 1>(0, 3), std::exp(q / kPi) * pose.block<3, 1>(0, 2);
  return w;
}

double net_roll_deg(const Model& model, const Positions& positions) {
  double sum = model.robot().net_roll_offset_deg;
  for (const RollTerm& term : model.robot().net_roll) {
    sum += term.sign * model.variable(term.joint, at(positions, term.joint));
  }
  return sum;
}

double opening_mm(const Model& model, Counts tool_position) {
  const Tool& tool = model.robot().tool;
  const double variable = model.variable(model.tool_index(), tool_position);
  if (tool.kind == ToolKind::kParallel) return variable;
  return 2.0 * tool.finger_length_mm * sin_cos_deg(variable / 2.0).sin;
}

}  // namespace xr3
