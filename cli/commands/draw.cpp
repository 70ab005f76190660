#include "cli/commands/commands.hpp"
#include "cli/options/pose_argument.hpp"
#include "core/coupling.hpp"
#include "core/home.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/load_model.hpp"
#include "server/files/png.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/svg.hpp"

namespace xr3 {
namespace {

State state_for(const Model& model, const DrawOptions& options) {
  State state = initial_state(model);
  const Positions counts = motor_counts(model, pose_argument(model, options.joints, options.tool));
  for (int i = 0; i < model.motor_count(); ++i) {
    state.motor(i).count = counts[static_cast<std::size_t>(i)];
  }
  return state;
}

}  // namespace

ExitCode run_command(const DrawOptions& options) {
  const ModelPtr model = load_model({options.robot, options.workcell});
  const Picture picture =
      drawing(*model, state_for(*model, options), options.view, options.width_px);
  const bool is_svg = options.out.ends_with(".svg");
  write_file(options.out, is_svg ? to_svg(picture) : to_png(rasterized(picture)));
  return ExitCode::kGood;
}

}  // namespace xr3
