#include "core/drawing/wireframe.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/drawing/stick_figure.hpp"
#include "core/drawing/strokes.hpp"
#include "core/grasp.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kWiresPerBlock = 4;

Eigen::Vector3d vector(const PointMm& p) { return {p.x, p.y, p.z}; }

Eigen::Vector3d carried(const Transform& pose, const Eigen::Vector3d& p) {
  return pose.block<3, 3>(0, 0) * p + pose.block<3, 1>(0, 3);
}

/// Adds the strokes of an outline; `place` transforms the points.
template <class Place>
void add_outline(std::vector<Wire>& wires, const std::string& part, int color,
                 const std::vector<OutlinePoint>& outline, Place place) {
  for (Stroke& stroke : strokes_of(outline)) {
    for (Eigen::Vector3d& p : stroke) p = place(p);
    wires.push_back({part, color, std::move(stroke)});
  }
}

std::string link_part(std::size_t link, std::size_t last) {
  if (link == 0) return "base";
  return link == last ? "tool" : "link" + std::to_string(link);
}

/// Transform of one part of the tool within frame n: from closed jaws to the current opening.
Transform jaw_shift(const Model& model, const ToolPart& part, Counts tool_position) {
  const double variable = model.variable(model.tool_index(), tool_position);
  Transform shift = Transform::Identity();
  if (model.robot().tool.kind == ToolKind::kParallel) {
    shift(1, 3) = part.side * variable / 2;
    return shift;
  }
  const auto [sin, cos] = sin_cos_deg(part.side * variable / 2);
  shift(1, 1) = cos;
  shift(1, 2) = -sin;
  shift(2, 1) = sin;
  shift(2, 2) = cos;
  const Eigen::Vector3d pivot = vector(part.pivot_mm);
  shift.block<3, 1>(0, 3) = pivot - shift.block<3, 3>(0, 0) * pivot;
  return shift;
}

std::string finger_part(int side) { return side > 0 ? "finger+1" : "finger-1"; }

/// A circle about the carousel's axis, with corners that turn with it.
Wire carousel_ring(const Carousel& carousel, double angle_deg, double radius_mm, double z_mm) {
  Wire ring{"carousel", carousel.color, {}};
  for (int i = 0; i <= kRingCorners; ++i) {
    const auto [sin, cos] = sin_cos_deg(angle_deg + 360.0 / kRingCorners * i);
    ring.points.emplace_back(carousel.x_mm + radius_mm * cos, carousel.y_mm + radius_mm * sin,
                             z_mm);
  }
  return ring;
}

/// The table, a disc with two diameters that show its angle, on a column.
void add_carousel(std::vector<Wire>& wires, const Model& model, const Positions& positions) {
  const Carousel& carousel = *model.robot().carousel;
  const int index = model.carousel_index();
  const double angle = model.variable(index, positions[static_cast<std::size_t>(index)]);
  const double underside = std::max(carousel.height_mm - kTableThicknessMm, 0.0);
  const double column = carousel.radius_mm / 4;
  const Wire top = carousel_ring(carousel, angle, carousel.radius_mm, carousel.height_mm);
  wires.push_back(top);
  wires.push_back(carousel_ring(carousel, angle, carousel.radius_mm, underside));
  wires.push_back(carousel_ring(carousel, angle, column, underside));
  wires.push_back(carousel_ring(carousel, angle, column, 0));
  for (const std::size_t i : {std::size_t{0}, std::size_t{kRingCorners / 4}}) {
    wires.push_back(
        {"carousel", carousel.color, {top.points[i], top.points[i + kRingCorners / 2]}});
  }
}

/// One polyline for bottom, top and an upright edge, and three for the other upright edges. Every
/// corner has three edges, so fewer than four polylines cannot draw a box.
void add_box(std::vector<Wire>& wires, const Block& block, const Transform& pose) {
  const Eigen::Vector3d half(mm(block.size_um.x) / 2, mm(block.size_um.y) / 2,
                             mm(block.size_um.z) / 2);
  const auto corner = [&](int x, int y, int z) {
    return carried(pose, half.cwiseProduct(Eigen::Vector3d(x, y, z)));
  };
  const std::array<Eigen::Vector3d, 4> bottom{corner(-1, -1, -1), corner(1, -1, -1),
                                              corner(1, 1, -1), corner(-1, 1, -1)};
  const std::array<Eigen::Vector3d, 4> top{corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1),
                                           corner(-1, 1, 1)};
  const std::string part = "block:" + block.name;
  wires.push_back({part,
                   block.color,
                   {bottom[0], bottom[1], bottom[2], bottom[3], bottom[0],  //
                    top[0], top[1], top[2], top[3], top[0]}});
  for (std::size_t i = 1; i < bottom.size(); ++i) {
    wires.push_back({part, block.color, {bottom[i], top[i]}});
  }
}

void append(std::vector<Wire>& wires, std::vector<Wire> more) {
  wires.insert(wires.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

Eigen::Vector3d point_mm(const PointUm& p) { return {mm(p.x), mm(p.y), mm(p.z)}; }

}  // namespace

std::vector<Wire> robot_wires(const Model& model, const Positions& positions) {
  const std::vector<Transform> frames = base_transforms(model, positions);
  const std::optional<Robot> figure = stick_figure(model.robot());
  const Robot& robot = figure ? *figure : model.robot();
  const std::vector<Outline>& links = robot.links;
  std::vector<Wire> wires;
  for (std::size_t k = 0; k < links.size(); ++k) {
    add_outline(wires, link_part(k, links.size() - 1), links[k].color, links[k].points,
                [&](const Eigen::Vector3d& p) { return carried(frames[k], p); });
  }
  const Counts tool = positions[static_cast<std::size_t>(model.tool_index())];
  for (const ToolPart& part : robot.tool.parts) {
    const Transform pose = frames.back() * jaw_shift(model, part, tool);
    add_outline(wires, finger_part(part.side), part.color, part.points,
                [&](const Eigen::Vector3d& p) { return carried(pose, p); });
  }
  if (model.carousel()) add_carousel(wires, model, positions);
  return wires;
}

std::vector<Wire> block_wires(const Model& model, const State& state) {
  std::vector<Wire> wires;
  wires.reserve(kWiresPerBlock * state.blocks.size());
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    add_box(wires, state.blocks[i], block_pose(model, state, i));
  }
  return wires;
}

std::vector<Wire> path_wires(const State& state) {
  const std::vector<PointUm>& points = state.tip_path.points;
  if (points.size() < 2) return {};
  Wire path{"path", kPathColor, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    path.points.push_back(point_mm(points[(state.tip_path.oldest + i) % points.size()]));
  }
  return {path};
}

std::vector<Wire> wireframe(const Model& model, const State& state) {
  std::vector<Wire> wires = robot_wires(model, positions(model, state.motors));
  append(wires, block_wires(model, state));
  append(wires, path_wires(state));
  return wires;
}

Wire surface_wire(const Workcell& workcell) {
  const double x = mm(workcell.workspace.x_um);
  const double y = mm(workcell.workspace.y_um);
  const double z = mm(workcell.work_surface_um);
  return {"surface", kSurfaceColor, {{0, -y, z}, {x, -y, z}, {x, y, z}, {0, y, z}, {0, -y, z}}};
}

std::vector<FlatWire> projected(const View& view, const std::vector<Wire>& wires) {
  std::vector<FlatWire> flat;
  flat.reserve(wires.size());
  for (const Wire& wire : wires) {
    flat.push_back({wire.part, wire.color, {}});
    flat.back().points.reserve(wire.points.size());
    for (const Eigen::Vector3d& p : wire.points) flat.back().points.push_back(projected(view, p));
  }
  return flat;
}

double behind_mm(const Model& model) {
  double furthest = 0;
  for (const Wire& wire : robot_wires(model, Positions{})) {
    for (const Eigen::Vector3d& p : wire.points) furthest = std::max(furthest, -p.x());
  }
  return furthest;
}

}  // namespace xr3
