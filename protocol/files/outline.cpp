#include "protocol/files/outline.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/files/drive.hpp"

namespace xr3::data {
namespace {

constexpr std::size_t kMaxPoints = 4096;
constexpr int kLastColor = 15;

/// Reads the three elements of a list from index `first` on.
bool read_coordinates(const Place& place, std::size_t first, PointMm& result) {
  const Codec<double> coordinate = length(kCoordinate);
  bool is_good = coordinate.read(place.element(first), result.x);
  is_good = coordinate.read(place.element(first + 1), result.y) && is_good;
  return coordinate.read(place.element(first + 2), result.z) && is_good;
}

Codec<PointMm> point() {
  const std::string allowed = "a list [x, y, z] of three lengths";
  Codec<PointMm> codec;
  codec.allowed = allowed;
  codec.read = [allowed](const Place& place, PointMm& result) {
    if (!place.value.is_list() || place.value.size() != 3) return place.refuse(allowed);
    return read_coordinates(place, 0, result);
  };
  codec.write = [](const PointMm& p) {
    return Json::array({number_json(p.x), number_json(p.y), number_json(p.z)});
  };
  return codec;
}

Codec<OutlinePoint> outline_point() {
  const std::string allowed = "[\"move\", x, y, z] or [\"draw\", x, y, z]";
  Codec<OutlinePoint> codec;
  codec.allowed = allowed;
  codec.read = [allowed](const Place& place, OutlinePoint& result) {
    const bool is_point = place.value.is_list() && place.value.size() == 4;
    const JsonValue pen = is_point ? place.value.element(0) : JsonValue();
    if (!pen.is("move") && !pen.is("draw")) return place.refuse(allowed);
    result.draw = pen.is("draw");
    return read_coordinates(place, 1, result.p_mm);
  };
  codec.write = [](const OutlinePoint& point) {
    return Json::array({point.draw ? "draw" : "move", number_json(point.p_mm.x),
                        number_json(point.p_mm.y), number_json(point.p_mm.z)});
  };
  return codec;
}

}  // namespace

Members<Outline> outline_members() {
  return {required("color", &Outline::color, whole_number(0, kLastColor)),
          required("points", &Outline::points, list(outline_point(), 0, kMaxPoints))};
}

Members<ToolPart> tool_part_members() {
  return {required("side", &ToolPart::side, sign()),
          required("color", &ToolPart::color, whole_number(0, kLastColor)),
          optional("pivot", &ToolPart::pivot_mm, point()),
          required("points", &ToolPart::points, list(outline_point(), 0, kMaxPoints))};
}

}  // namespace xr3::data
