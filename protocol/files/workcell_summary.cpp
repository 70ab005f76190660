#include <array>
#include <string>
#include <vector>

#include "protocol/files/summary.hpp"
#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

constexpr std::array<const char*, 16> kColorNames = {
    "black",      "blue",           "green",  "cyan",        "red",          "magenta",
    "brown",      "light grey",     "grey",   "bright blue", "bright green", "bright cyan",
    "bright red", "bright magenta", "yellow", "white"};

std::string length(Micrometres um) { return plain_number(mm(um)); }

std::string heading(const Workcell& workcell) {
  const std::size_t count = workcell.blocks.size();
  std::string text = printable_line(workcell.name) + ": " + std::to_string(count) +
                     (count == 1 ? " block, " : " blocks, ") +
                     (workcell.camera ? "a camera\n" : "no camera\n");
  if (!workcell.notes.empty()) text += workcell.notes + "\n";
  return text;
}

std::string space_text(const Workcell& workcell) {
  const Workspace& space = workcell.workspace;
  return "Workspace: x 0 to " + length(space.x_um) + ", y -" + length(space.y_um) + " to " +
         length(space.y_um) + ", z 0 to " + length(space.z_um) +
         " mm\nWork surface: z = " + length(workcell.work_surface_um) +
         " mm; a tool tip under it " +
         (workcell.surface_stalls ? "stalls the robot\n" : "raises a warning\n");
}

std::string block_table(const std::vector<Block>& blocks) {
  std::vector<std::vector<std::string>> rows = {
      {"block", "length", "width", "height", "x", "y", "z mm", "yaw deg", "colour"}};
  for (const Block& block : blocks) {
    rows.push_back({block.name, length(block.size_um.x), length(block.size_um.y),
                    length(block.size_um.z), length(block.centroid_um.x),
                    length(block.centroid_um.y), length(block.centroid_um.z),
                    plain_number(degrees(block.yaw_udeg)),
                    kColorNames[static_cast<std::size_t>(block.color)]});
  }
  return blocks.empty() ? "" : "\n" + text_table(rows, "lrrrrrrrl") + "\n";
}

std::string camera_text(const Camera& camera) {
  const PointUm& at = camera.location_um;
  const bool is_perspective = camera.projection == Projection::kPerspective;
  return "Camera: at (" + length(at.x) + ", " + length(at.y) + ", " + length(at.z) + ") mm, " +
         (is_perspective ? "perspective" : "orthographic") + ", field " +
         length(camera.field_x_um) + " x " + length(camera.field_y_um) + " mm, " +
         std::to_string(camera.pixels_x) + " x " + std::to_string(camera.pixels_y) + " pixels of " +
         plain_number(mm(camera.field_x_um) / camera.pixels_x) + " x " +
         plain_number(mm(camera.field_y_um) / camera.pixels_y) + " mm\n";
}

}  // namespace

std::string workcell_summary(const Workcell& workcell) {
  return heading(workcell) + space_text(workcell) + block_table(workcell.blocks) +
         (workcell.camera ? camera_text(*workcell.camera) : "");
}

}  // namespace xr3
