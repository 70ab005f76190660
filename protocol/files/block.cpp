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
  const std::string range_text = item.allowed.substr(std::string_view("a length ").size());
  return row<PointUm>("a list " + names + " of three lengths, each " + range_text, item,
                      {&PointUm::x, &PointUm::y, &PointUm::z});
}

Codec<Microdegrees> yaw() {
  return converted<Microdegrees, double>(
      number({-kTurnDeg, kTurnDeg, false, "degrees"}),
      [](const double& angle_deg) { return normalized(microdegrees(angle_deg)); }, degrees);
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
