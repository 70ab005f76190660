#include "core/kinematics.hpp"

#include <cassert>
#include <cmath>
#include <optional>

namespace xr3 {
namespace {

Counts at(const Positions& positions, int index) {
  return positions[static_cast<std::size_t>(index)];
}

/// Transforms a point to the previous frame. A point on the joint's own axis, as the tip is for the
/// roll, needs no rotation; `theta` is then not called.
template <class Theta>
void to_previous_frame(PointMm& p, const SinCos& alpha, double d, double a, Theta theta) {
  const double along = p.x + a;
  const double across = alpha.cos * p.y - alpha.sin * p.z;
  p.z = alpha.sin * p.y + alpha.cos * p.z + d;
  const bool on_axis = along == 0.0 && across == 0.0;
  const SinCos turn = on_axis ? SinCos{} : theta();
  p.x = turn.cos * along - turn.sin * across;
  p.y = turn.sin * along + turn.cos * across;
}

/// The place of the arm behind its first slides.
Transform behind_slides(const Model& model, const Positions& positions) {
  Transform place = mount_transform(model);
  for (int k = 0; k < model.slide_count(); ++k) place *= link_transform(model, k, at(positions, k));
  return place;
}

}  // namespace

Transform row_transform(const SinCos& theta, const SinCos& alpha, double d, double a) {
  Transform t;
  t << theta.cos, -alpha.cos * theta.sin, alpha.sin * theta.sin, a * theta.cos,  //
      theta.sin, alpha.cos * theta.cos, -alpha.sin * theta.cos, a * theta.sin,   //
      0.0, alpha.sin, alpha.cos, d,                                              //
      0.0, 0.0, 0.0, 1.0;
  return t;
}

Transform link_transform(const Model& model, int joint, Counts position) {
  return row_transform(model.theta(joint, position), model.twist(joint),
                       model.link_offset_mm(joint, position), model.link_length_mm(joint));
}

Transform mount_transform(const Model& model) {
  if (!model.mount_angles()) return Transform::Identity();
  const DhRow& row = *model.robot().mount;
  return row_transform(model.mount_angles()->theta, model.mount_angles()->twist, row.d_mm,
                       row.a_mm);
}

std::vector<Transform> base_transforms(const Model& model, const Positions& positions) {
  std::vector<Transform> chain;
  chain.reserve(static_cast<std::size_t>(model.joint_count()) + 1);
  chain.push_back(mount_transform(model));
  for (int k = 0; k < model.joint_count(); ++k) {
    chain.push_back(chain.back() * link_transform(model, k, at(positions, k)));
  }
  return chain;
}

Transform tool_transform(const Model& model, const Positions& positions) {
  assert(model.joint_count() > 0);
  Transform pose = link_transform(model, 0, at(positions, 0));
  if (model.mount_angles()) pose = mount_transform(model) * pose;
  for (int k = 1; k < model.joint_count(); ++k) pose *= link_transform(model, k, at(positions, k));
  return pose;
}

// Transforms a point, from the tip inwards, instead of multiplying matrices: a dozen
// multiplications per joint.
PointUm tool_tip(const Model& model, const Positions& positions) {
  PointMm p;
  for (int k = model.joint_count() - 1; k >= 0; --k) {
    const Counts position = at(positions, k);
    to_previous_frame(p, model.twist(k), model.link_offset_mm(k, position), model.link_length_mm(k),
                      [&] { return model.theta(k, position); });
  }
  if (const std::optional<MountAngles>& mount = model.mount_angles()) {
    const DhRow& row = *model.robot().mount;
    to_previous_frame(p, mount->twist, row.d_mm, row.a_mm, [&] { return mount->theta; });
  }
  return {micrometres(p.x), micrometres(p.y), micrometres(p.z)};
}

PointUm base_shift(const Model& model, const Positions& positions) {
  if (model.slide_count() == 0) return {};
  const Transform now = behind_slides(model, positions);
  const Transform home = behind_slides(model, Positions{});
  return {micrometres(now(0, 3) - home(0, 3)), micrometres(now(1, 3) - home(1, 3)), 0};
}

ToolConfiguration tool_configuration(const Model& model, const Positions& positions) {
  const Transform pose = tool_transform(model, positions);
  const int last = model.joint_count() - 1;
  return configuration_of(pose, model.robot(), model.variable(last, at(positions, last)));
}

ToolConfiguration configuration_of(const Transform& pose, const Robot& robot, double last) {
  const double q = robot.joints.back().is_revolute() ? last * kPi / 180.0 : last;
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
