#include "protocol/files/workcell.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/files/kind.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

Members<Workspace> workspace_members() {
  return {required("x", &Workspace::x_um, length_um(kSize)),
          required("y", &Workspace::y_um, length_um(kSize)),
          required("z", &Workspace::z_um, length_um(kSize))};
}

Members<Camera> camera_members(int max_pixels) {
  return {required("location", &Camera::location_um, point_um(kCoordinate, "[x, y, z]")),
          required("field", row<Camera>("a list [length, width] of two lengths", length_um(kSize),
                                        {&Camera::field_x_um, &Camera::field_y_um})),
          required("pixels", row<Camera>("a list [columns, rows] of two whole numbers",
                                         whole_number(1, max_pixels),
                                         {&Camera::pixels_x, &Camera::pixels_y})),
          optional("projection", &Camera::projection,
                   choice<Projection>({{"orthographic", Projection::kOrthographic},
                                       {"perspective", Projection::kPerspective}}))};
}

Members<Workcell> members_within(std::size_t max_blocks, int max_pixels) {
  return {
      required("name", &Workcell::name, text(1, 80)),
      optional("notes", &Workcell::notes, text(0, 4000)),
      length_unit_member<Workcell>(),
      required("workspace", &Workcell::workspace, object(workspace_members())),
      optional("work_surface", &Workcell::work_surface_um, length_um(kCoordinate)),
      optional("surface_stalls", &Workcell::surface_stalls, boolean()),
      required("blocks", &Workcell::blocks, shared(list(object(block_members()), 0, max_blocks))),
      optional("camera", &Workcell::camera, object(camera_members(max_pixels)))};
}

const Members<Workcell>& workcell_members(WorkcellBounds bounds) {
  static const Members<Workcell> of_files = members_within(kMaxFileBlocks, kMaxFilePixels);
  static const Members<Workcell> of_saved = members_within(kMaxBlocks, kMaxSavedPixels);
  return bounds == WorkcellBounds::kFile ? of_files : of_saved;
}

}  // namespace

std::optional<Workcell> read_workcell(Reading& reading, const Robot* robot, std::size_t first_reach,
                                      WorkcellBounds bounds) {
  return read_root(reading, workcell_members(bounds), [&](const Workcell& workcell, Reading&) {
    check_workcell(workcell, robot, first_reach, reading);
  });
}

FileReading<Workcell> read_workcell(std::string_view text, const std::string& file,
                                    const Robot* robot, std::size_t first_reach,
                                    WorkcellBounds bounds) {
  return read_file(text, file, DataKind::kWorkcell, Unit::kOfDocument, [&](Reading& reading) {
    return read_workcell(reading, robot, first_reach, bounds);
  });
}

Workcell load_workcell(std::string_view text, const std::string& file) {
  return value_of(read_workcell(text, file));
}

Json workcell_to_json(const Workcell& workcell) {
  return write_object(workcell, workcell_members(WorkcellBounds::kSaved));
}

}  // namespace xr3
