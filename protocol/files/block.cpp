#include "protocol/files/block.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

namespace xr3::data {
namespace {

constexpr double kTurnDeg = 360;

}  // namespace

Codec<Micrometres> length_um(Range range) {
  const Codec<double> in_mm = length(range);
  Codec<Micrometres> codec;
  codec.allowed = in_mm.allowed;
  codec.read = [in_mm, range](const Place& place, Micrometres& result) {
    double length_mm = 0;
    const bool is_good = in_mm.read(place, length_mm);
    result = micrometres(length_mm);
    // A length that must be above the minimum must also be so after rounding to micrometres.
    const bool is_nothing = is_good && range.open_min && result <= micrometres(range.min);
    return is_nothing ? place.refuse(in_mm.allowed) : is_good;
  };
  codec.write = [](const Micrometres& um) { return number_json(mm(um)); };
  return codec;
}

Codec<PointUm> point_um(Range range, const std::string& names) {
  const Codec<Micrometres> item = length_um(range);
  Codec<PointUm> codec;
  const std::string range_text = item.allowed.substr(std::string_view("a length ").size());
  codec.allowed = "a list " + names + " of three lengths, each " + range_text;
  codec.read = [item, allowed = codec.allowed](const Place& place, PointUm& p) {
    if (!place.value.is_list() || place.value.size() != 3) return place.refuse(allowed);
    const bool has_x = item.read(place.element(0), p.x);
    const bool has_y = item.read(place.element(1), p.y);
    return item.read(place.element(2), p.z) && has_x && has_y;
  };
  codec.write = [](const PointUm& p) {
    return Json::array({number_json(mm(p.x)), number_json(mm(p.y)), number_json(mm(p.z))});
  };
  return codec;
}

Codec<Microdegrees> yaw() {
  const Codec<double> in_degrees = number({-kTurnDeg, kTurnDeg, false, "degrees"});
  Codec<Microdegrees> codec;
  codec.allowed = in_degrees.allowed;
  codec.read = [in_degrees](const Place& place, Microdegrees& result) {
    double angle_deg = 0;
    const bool is_good = in_degrees.read(place, angle_deg);
    constexpr Microdegrees kHalfTurn = 180000000;
    result = microdegrees(angle_deg);
    while (result > kHalfTurn) result -= 2 * kHalfTurn;
    while (result <= -kHalfTurn) result += 2 * kHalfTurn;
    return is_good;
  };
  codec.write = [](const Microdegrees& angle) { return number_json(degrees(angle)); };
  return codec;
}

Codec<std::string> block_name() { return text(1, 40); }

Codec<PointUm> block_size() { return point_um(kSize, "[length, width, height]"); }

Codec<PointUm> block_centroid() { return point_um(kCoordinate, "[x, y, z]"); }

Codec<int> block_color() { return whole_number(0, 15); }

Members<Block> block_members() {
  return {required("name", &Block::name, block_name()),
          required("size", &Block::size_um, block_size()),
          required("centroid", &Block::centroid_um, block_centroid()),
          required("yaw_deg", &Block::yaw_udeg, yaw()),
          required("color", &Block::color, block_color())};
}

}  // namespace xr3::data
