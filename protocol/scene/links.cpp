#include "protocol/scene/links.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/drawing/stick_figure.hpp"
#include "core/drawing/wireframe.hpp"

namespace xr3 {
namespace {

constexpr double kInsetMm = 0.1;  ///< faces of two links are as far apart

Eigen::Vector3d vector_of(const PointMm& p) { return {p.x, p.y, p.z}; }

Transform translation(const Eigen::Vector3d& p) {
  Transform t = Transform::Identity();
  t.block<3, 1>(0, 3) = p;
  return t;
}

Transform rotation(const Eigen::Vector3d& axis, double angle_deg) {
  const auto [sin, cos] = sin_cos_deg(angle_deg);
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  Transform t = Transform::Identity();
  t.block<3, 3>(0, 0) += sin * cross + (1 - cos) * cross * cross;
  return t;
}

/// The part of a joint's row that is constant, which follows the motion.
Transform constant_part(const Joint& joint) {
  const bool turns = joint.is_revolute();
  return row_transform(sin_cos_deg(turns ? 0 : joint.dh.theta_deg), sin_cos_deg(joint.dh.alpha_deg),
                       turns ? joint.dh.d_mm : 0, joint.dh.a_mm);
}

std::vector<Stroke> placed_strokes(const std::vector<OutlinePoint>& outline,
                                   const Transform& place) {
  std::vector<Stroke> strokes = strokes_of(outline);
  for (Stroke& stroke : strokes)
    for (Eigen::Vector3d& p : stroke) p = place.block<3, 3>(0, 0) * p + place.block<3, 1>(0, 3);
  return strokes;
}

/// A polygon as wide as a circle about z.
Stroke ring(double radius_mm, double z_mm) {
  Stroke ring;
  for (int i = 0; i <= kRingCorners; ++i) {
    const auto [sin, cos] = sin_cos_deg(360.0 / kRingCorners * i);
    ring.emplace_back(radius_mm * cos, radius_mm * sin, z_mm);
  }
  return ring;
}

/// A disc with two diameters, and its column, in the frame of the carousel.
std::vector<Stroke> carousel_strokes(const Carousel& carousel) {
  const double underside = std::max(carousel.height_mm - kTableThicknessMm, 0.0);
  const Stroke top = ring(carousel.radius_mm, carousel.height_mm);
  std::vector<Stroke> strokes{top, ring(carousel.radius_mm, underside),
                              ring(carousel.radius_mm / 4, underside),
                              ring(carousel.radius_mm / 4, 0)};
  for (const std::size_t i : {std::size_t{0}, std::size_t{kRingCorners / 4}})
    strokes.push_back({top[i], top[i + kRingCorners / 2]});
  return strokes;
}

/// Adds the links of a robot with outlines, one after the other.
class LinkTree {
 public:
  LinkTree(const Model& model, const Robot& robot, BareStrokes bare)
      : model_(model),
        robot_(robot),
        bare_(bare),
        solids_(2 + model.joint_count() + static_cast<int>(robot.tool.parts.size())) {}

  std::vector<SceneLink> links() && {
    add_base();
    for (int k = 0; k < model_.joint_count(); ++k) add_joint(k);
    add({.name = "tool", .parent = last(), .place = rest_});
    const int tool = last();
    for (const ToolPart& part : robot_.tool.parts) add_finger(part, tool);
    if (robot_.carousel) add_carousel(*robot_.carousel);
    return std::move(links_);
  }

 private:
  int last() const { return static_cast<int>(links_.size()) - 1; }

  void add(SceneLink link) { links_.push_back(std::move(link)); }

  /// Adds a link with a solid, drawn in less than those before it: its faces are in front.
  void add(SceneLink link, int color, std::vector<Stroke> strokes) {
    link.color = color;
    link.solid = solid_of(std::move(strokes), kInsetMm * solids_--, bare_);
    add(std::move(link));
  }

  void add_base() {
    rest_ = mount_transform(model_);
    const Outline& outline = robot_.links[0];
    add({.name = "base", .place = Transform::Identity()}, outline.color,
        placed_strokes(outline.points, rest_));
  }

  void add_joint(int index) {
    const Joint& joint = robot_.joints[static_cast<std::size_t>(index)];
    const Outline& outline = robot_.links[static_cast<std::size_t>(index) + 1];
    SceneLink link{.name = std::string("link_") + joint.drive.label,
                   .parent = last(),
                   .place = rest_,
                   .motion = joint.is_revolute() ? LinkMotion::kTurns : LinkMotion::kSlides,
                   .motor = index};
    rest_ = constant_part(joint);
    add(std::move(link), outline.color, placed_strokes(outline.points, rest_));
  }

  void add_finger(const ToolPart& part, int tool) {
    const bool slides = robot_.tool.kind == ToolKind::kParallel;
    const Eigen::Vector3d pivot = vector_of(part.pivot_mm);
    add({.name = "finger_" + std::to_string(last() - tool + 1),
         .parent = tool,
         .place = translation(pivot),
         .motion = slides ? LinkMotion::kSlides : LinkMotion::kTurns,
         .axis = part.side * (slides ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX()),
         .motor = model_.tool_index(),
         .ratio = 0.5},
        part.color, placed_strokes(part.points, translation(-pivot)));
  }

  void add_carousel(const Carousel& carousel) {
    add({.name = "carousel",
         .parent = 0,
         .place = translation({carousel.x_mm, carousel.y_mm, 0}),
         .motion = LinkMotion::kTurns,
         .motor = model_.carousel_index()},
        carousel.color, carousel_strokes(carousel));
  }

  const Model& model_;
  const Robot& robot_;
  BareStrokes bare_;
  int solids_;  ///< the number that is still to be added: base, joints, fingers and carousel
  Transform rest_ = Transform::Identity();  ///< place of the next link in the frame of the last one
  std::vector<SceneLink> links_;
};

}  // namespace

std::vector<SceneLink> scene_links(const Model& model) {
  const std::optional<Robot> figure = stick_figure(model.robot());
  return LinkTree(model, figure ? *figure : model.robot(),
                  figure ? BareStrokes::kRods : BareStrokes::kLines)
      .links();
}

Transform relative_pose(const SceneLink& link, double variable) {
  const double value = link.ratio * variable;
  switch (link.motion) {
    case LinkMotion::kFixed: return link.place;
    case LinkMotion::kTurns: return link.place * rotation(link.axis, value);
    case LinkMotion::kSlides: return link.place * translation(value * link.axis);
  }
  return link.place;  // unreachable: all motions are above
}

}  // namespace xr3
