#include "core/kinematics.hpp"

#include <cmath>

namespace xr3 {
namespace {

struct LinkFigures {
  SinCos theta;
  SinCos alpha;
  double d_mm;
  double a_mm;
};

LinkFigures figures(const Model& model, int joint, Counts position) {
  const Joint& link = model.robot().joints[static_cast<std::size_t>(joint)];
  const bool slides = link.variable == JointVariable::kD;
  const double d = slides ? model.variable(joint, position) : link.dh.d_mm;
  return {model.theta(joint, position), model.twist(joint), d, link.dh.a_mm};
}

Counts at(const Positions& positions, int index) {
  return positions[static_cast<std::size_t>(index)];
}

}  // namespace

Transform link_transform(const Model& model, int joint, Counts position) {
  const auto [theta, alpha, d, a] = figures(model, joint, position);
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

// From the tip inwards, a point instead of matrices: a dozen multiplications a joint.
PointUm tool_tip(const Model& model, const Positions& positions) {
  double x = 0;
  double y = 0;
  double z = 0;
  for (int k = model.joint_count() - 1; k >= 0; --k) {
    const auto [theta, alpha, d, a] = figures(model, k, at(positions, k));
    const double along = x + a;
    const double across = alpha.cos * y - alpha.sin * z;
    const double up = alpha.sin * y + alpha.cos * z;
    x = theta.cos * along - theta.sin * across;
    y = theta.sin * along + theta.cos * across;
    z = up + d;
  }
  return {micrometres(x), micrometres(y), micrometres(z)};
}

ToolConfiguration tool_configuration(const Model& model, const Positions& positions) {
  const Transform pose = tool_transform(model, positions);
  const int last = model.joint_count() - 1;
  const bool turns = model.robot().joints.back().variable == JointVariable::kTheta;
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
