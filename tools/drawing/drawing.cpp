#include "tools/drawing/drawing.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/drawing/view.hpp"
#include "core/drawing/wireframe.hpp"

namespace xr3 {
namespace {

std::string title(const Model& model, const ViewVector& view) {
  return model.robot().name + " seen from (" + std::to_string(view.x) + ", " +
         std::to_string(view.y) + ", " + std::to_string(view.z) + ")";
}

}  // namespace

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

}  // namespace xr3
