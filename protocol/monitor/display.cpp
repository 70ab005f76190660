#include "protocol/monitor/display.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/drawing/palette.hpp"
#include "core/drawing/status_line.hpp"
#include "core/drawing/view.hpp"
#include "core/drawing/wireframe.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {
namespace {

constexpr int kTicksPerHalfSecond = kTickHz / 2;

Json flat_json(const Eigen::Vector2d& p) {
  return Json::array({rounded(p.x(), kMmDecimals), rounded(p.y(), kMmDecimals)});
}

Json polyline_json(const FlatWire& wire) {
  Json::array_t points;
  points.reserve(wire.points.size());
  for (const Eigen::Vector2d& p : wire.points) points.push_back(flat_json(p));
  Json::object_t members;
  members.reserve(3);  // an object that grows copies its members
  members["part"] = wire.part;
  members["color"] = color_hex(wire.color, Background::kDark);
  members["points"] = std::move(points);
  return members;
}

Json polylines_json(const View& view, const Model& model, const State& state) {
  Json polylines = Json::array();
  for (const FlatWire& wire : projected(view, wireframe(model, state))) {
    polylines.push_back(polyline_json(wire));
  }
  return polylines;
}

Json extents_json(const View& view, const Model& model) {
  const Extents extents = view_extents(view, model.workcell().workspace, behind_mm(model));
  return Json::array({rounded(extents.low.x(), kMmDecimals), rounded(extents.low.y(), kMmDecimals),
                      rounded(extents.high.x(), kMmDecimals),
                      rounded(extents.high.y(), kMmDecimals)});
}

}  // namespace

Json display_json(const Model& model, const State& state) {
  const DisplaySettings& display = state.display;
  const View view = view_along(display.view);
  return {{"on", display.on},
          {"view", Json::array({display.view.x, display.view.y, display.view.z})},
          {"erase", display.erase},
          {"period_ticks", display.period_half_s * kTicksPerHalfSecond},
          {"function_keys", display.function_keys},
          {"extents_mm", extents_json(view, model)},
          {"polylines", polylines_json(view, model, state)},
          {"status", {{"option", display.status_option}, {"text", status_line(model, state)}}}};
}

}  // namespace xr3
