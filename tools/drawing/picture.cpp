#include "tools/drawing/picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace xr3 {
namespace {

constexpr double kMaxHeights = 2;  ///< maximum height, in widths
constexpr double kMinSpanMm = 1;   ///< keeps the scale finite for an empty picture

std::string title(const Model& model, const ViewVector& view) {
  return model.robot().name + " seen from (" + std::to_string(view.x) + ", " +
         std::to_string(view.y) + ", " + std::to_string(view.z) + ")";
}

}  // namespace

Extents around(Extents extents, const std::vector<FlatWire>& wires) {
  for (const FlatWire& wire : wires) {
    for (const Eigen::Vector2d& p : wire.points) {
      extents.low = extents.low.cwiseMin(p);
      extents.high = extents.high.cwiseMax(p);
    }
  }
  return extents;
}

Picture lay_out(const std::vector<FlatWire>& wires, const Extents& extents, int width_px) {
  const double room = width_px - 2 * kPictureMarginPx;
  const double most_height = kMaxHeights * width_px - 2 * kPictureMarginPx;
  const Eigen::Vector2d span =
      (extents.high - extents.low).cwiseMax(Eigen::Vector2d::Constant(kMinSpanMm));
  const double scale = std::min(room / span.x(), most_height / span.y());
  Picture picture;
  picture.width_px = width_px;
  picture.height_px = static_cast<int>(std::ceil(span.y() * scale)) + 2 * kPictureMarginPx;
  picture.wires = wires;
  const double left = (width_px - span.x() * scale) / 2;
  for (FlatWire& wire : picture.wires) {
    for (Eigen::Vector2d& p : wire.points) {
      p = {left + (p.x() - extents.low.x()) * scale,
           kPictureMarginPx + (extents.high.y() - p.y()) * scale};
    }
  }
  return picture;
}

Picture drawing(const Model& model, const State& state, const ViewVector& vector, int width_px) {
  const View view = view_along(vector);
  std::vector<Wire> wires{surface_wire(model.workcell())};
  for (Wire& wire : wireframe(model, state)) wires.push_back(std::move(wire));
  const std::vector<FlatWire> flat = projected(view, wires);
  const Extents extents = view_extents(view, model.workcell().workspace, behind_mm(model));
  Picture picture = lay_out(flat, around(extents, flat), width_px);
  picture.title = title(model, vector);
  return picture;
}

double line_width_px(const std::string& part) { return part == "surface" ? 0.8 : 1.4; }

}  // namespace xr3
