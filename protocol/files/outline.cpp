#include "protocol/files/outline.hpp"

#include <string>

#include "protocol/files/drive.hpp"

namespace xr3::data {
namespace {

constexpr std::size_t kMaxPoints = 4096;
constexpr int kLastColor = 15;

Codec<Eigen::Vector3d> point() {
  const std::string allowed = "a list [x, y, z] of three lengths";
  Codec<Eigen::Vector3d> codec;
  codec.allowed = allowed;
  codec.read = [allowed, coordinate = length(kCoordinate)](const Place& place,
                                                           Eigen::Vector3d& result) {
    if (!place.value.is_list() || place.value.size() != 3) return place.refuse(allowed);
    bool is_good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      is_good = coordinate.read(place.element(i), result[static_cast<int>(i)]) && is_good;
    }
    return is_good;
  };
  codec.write = [](const Eigen::Vector3d& p) {
    return Json::array({number_json(p.x()), number_json(p.y()), number_json(p.z())});
  };
  return codec;
}

Codec<OutlinePoint> outline_point() {
  const std::string allowed = "[\"move\", x, y, z] or [\"draw\", x, y, z]";
  Codec<OutlinePoint> codec;
  codec.allowed = allowed;
  codec.read = [allowed, coordinate = length(kCoordinate)](const Place& place,
                                                           OutlinePoint& result) {
    const bool is_point = place.value.is_list() && place.value.size() == 4;
    const JsonValue pen = is_point ? place.value.element(0) : JsonValue();
    if (!pen.is("move") && !pen.is("draw")) return place.refuse(allowed);
    result.draw = pen.is("draw");
    bool is_good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      is_good = coordinate.read(place.element(i + 1), result.p_mm[static_cast<int>(i)]) && is_good;
    }
    return is_good;
  };
  codec.write = [](const OutlinePoint& point) {
    return Json::array({point.draw ? "draw" : "move", number_json(point.p_mm.x()),
                        number_json(point.p_mm.y()), number_json(point.p_mm.z())});
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
