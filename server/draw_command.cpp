#include "server/draw_command.hpp"

#include <utility>

#include "core/coupling.hpp"
#include "core/home.hpp"
#include "core/wireframe.hpp"
#include "protocol/svg.hpp"
#include "server/app.hpp"
#include "server/png.hpp"
#include "server/pose_argument.hpp"
#include "server/whole_file.hpp"

namespace xr3 {
namespace {

ModelPtr model_for(const DrawOptions& options) {
  ServeOptions cell;
  cell.robot = options.robot;
  cell.workcell = options.workcell;
  return load_model(cell);
}

State state_for(const Model& model, const DrawOptions& options) {
  State state = initial_state(model);
  const Positions counts = motor_counts(model, pose_argument(model, options.joints, options.tool));
  for (int i = 0; i < model.motor_count(); ++i) {
    state.motor(i).count = counts[static_cast<std::size_t>(i)];
  }
  return state;
}

std::string title(const Model& model, const ViewVector& view) {
  return model.robot().name + " seen from (" + std::to_string(view.x) + ", " +
         std::to_string(view.y) + ", " + std::to_string(view.z) + ")";
}

/// The table, too, and room for all that sticks out of the paper's view plane.
Picture picture_for(const Model& model, const State& state, const DrawOptions& options) {
  const View view = view_along(options.view);
  std::vector<Wire> wires{surface_wire(model.workcell())};
  for (Wire& wire : wireframe(model, state)) wires.push_back(std::move(wire));
  const std::vector<FlatWire> flat = projected(view, wires);
  const Extents extents = view_extents(view, model.workcell().workspace, behind_mm(model));
  Picture picture = lay_out(flat, around(extents, flat), options.width_px);
  picture.title = title(model, options.view);
  return picture;
}

}  // namespace

ExitCode draw(const DrawOptions& options) {
  const ModelPtr model = model_for(options);
  const Picture picture = picture_for(*model, state_for(*model, options), options);
  const bool is_svg = options.out.ends_with(".svg");
  write_whole_file(options.out, is_svg ? to_svg(picture) : to_png(rasterized(picture)),
                   Existing::kReplace, [](const DataFile&) {});
  return ExitCode::kGood;
}

}  // namespace xr3
