#include "protocol/files/workcell.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/files/workcell_consistency.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr int kMaxPixels = 2048;

Members<Workspace> workspace_members() {
  return {required("x", &Workspace::x_um, length_um(kSize)),
          required("y", &Workspace::y_um, length_um(kSize)),
          required("z", &Workspace::z_um, length_um(kSize))};
}

/// Two members of Camera that the file gives as one list.
template <class V>
Member<Camera> pair_of(std::string name, V Camera::*first, V Camera::*second, Codec<V> item,
                       const std::string& allowed) {
  Member<Camera> member;
  member.name = std::move(name);
  member.allowed = allowed;
  member.read = [=](const Place& place, Camera& camera) {
    if (!place.value.is_list() || place.value.size() != 2) return place.refuse(allowed);
    const bool has_first = item.read(place.element(0), camera.*first);
    return item.read(place.element(1), camera.*second) && has_first;
  };
  member.write = [=](const Camera& camera) {
    return Json::array({item.write(camera.*first), item.write(camera.*second)});
  };
  return member;
}

Members<Camera> camera_members() {
  return {required("location", &Camera::location_um, point_um(kCoordinate, "[x, y, z]")),
          pair_of("field", &Camera::field_x_um, &Camera::field_y_um, length_um(kSize),
                  "a list [length, width] of two lengths"),
          pair_of("pixels", &Camera::pixels_x, &Camera::pixels_y, whole_number(1, kMaxPixels),
                  "a list [columns, rows] of two whole numbers"),
          optional("projection", &Camera::projection,
                   choice<Projection>({{"orthographic", Projection::kOrthographic},
                                       {"perspective", Projection::kPerspective}}))};
}

const Members<Workcell>& workcell_members() {
  static const Members<Workcell> members = {
      required("name", &Workcell::name, text(1, 80)),
      optional("notes", &Workcell::notes, text(0, 4000)),
      length_unit_member<Workcell>(),
      required("workspace", &Workcell::workspace, object(workspace_members())),
      optional("work_surface", &Workcell::work_surface_um, length_um(kCoordinate)),
      optional("surface_stalls", &Workcell::surface_stalls, boolean()),
      required("blocks", &Workcell::blocks, list(object(block_members()), 0, kMaxBlocks)),
      optional("camera", &Workcell::camera, object(camera_members()))};
  return members;
}

}  // namespace

std::optional<Workcell> read_workcell(Reading& reading, const Robot* robot,
                                      std::size_t first_reach) {
  Workcell workcell;
  read_object(Place{reading, reading.root()}, workcell_members(), workcell);
  check_workcell(workcell, robot, first_reach, reading);
  return reading.has_errors() ? std::nullopt : std::optional(std::move(workcell));
}

WorkcellReading read_workcell(std::string_view text, const std::string& file, const Robot* robot,
                              std::size_t first_reach) try {
  const JsonSource source(text, file);
  refuse_other_kinds(source.root(), DataKind::kWorkcell, file);
  Reading reading(source);
  std::optional<Workcell> workcell = read_workcell(reading, robot, first_reach);
  return {std::move(workcell), reading.take_findings()};
} catch (const DataError& error) {
  return {std::nullopt, error.findings()};
}

Workcell load_workcell(std::string_view text, const std::string& file) {
  WorkcellReading reading = read_workcell(text, file);
  if (!reading.workcell) throw DataError(std::move(reading.findings));
  return *std::move(reading.workcell);
}

Json workcell_to_json(const Workcell& workcell) {
  return write_object(workcell, workcell_members());
}

}  // namespace xr3
