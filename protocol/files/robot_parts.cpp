#include "protocol/files/robot_parts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace xr3::data {
namespace {

constexpr double kMaxVariable = 1e6;
constexpr double kMaxPrecision = 1000;
constexpr int kMaxSwitchCounts = 1000000;
constexpr std::size_t kMaxOutlinePoints = 4096;
constexpr int kLastColor = 15;

/// The range of a variable, in degrees or in the file's length unit, depending on the kind of joint
/// or tool.
const Range kVariable{-kMaxVariable, kMaxVariable};

Codec<char> label() {
  const auto parse = [](JsonValue value) -> std::optional<char> {
    const std::string letters = value.is_text() ? value.text(2) : "";
    if (letters.size() != 1 || letters[0] < 'A' || letters[0] > 'H') return std::nullopt;
    return letters[0];
  };
  return parsed<char>("a letter \"A\" to \"H\"", parse,
                      [](const char& letter) { return Json(std::string(1, letter)); });
}

/// One of a few integers.
template <class I>
Codec<I> integer_among(std::string allowed, std::vector<int> values) {
  return parsed<I>(std::move(allowed),
                   [values = std::move(values)](JsonValue value) -> std::optional<I> {
                     for (const int each : values)
                       if (value.is(each)) return static_cast<I>(each);
                     return std::nullopt;
                   });
}

Codec<int> sign() { return integer_among<int>("1 or -1", {1, -1}); }

/// One of the six bits of a reply, or none.
Codec<std::uint8_t> mask() {
  return integer_among<std::uint8_t>("1, 2, 4, 8, 16 or 32, or 0 for none",
                                     {0, 1, 2, 4, 8, 16, 32});
}

Members<Microswitch> switch_members() {
  return {required("position", &Microswitch::position,
                   whole_number(-kMaxSwitchCounts, kMaxSwitchCounts)),
          required("mask", &Microswitch::mask, mask()),
          optional("width", &Microswitch::width, whole_number(1, kMaxSwitchCounts)),
          optional("period", &Microswitch::period, whole_number(2, kMaxSwitchCounts))};
}

Codec<OutlinePoint> outline_point() {
  Codec<OutlinePoint> codec;
  codec.allowed = "[\"move\", x, y, z] or [\"draw\", x, y, z]";
  codec.read = [allowed = codec.allowed, coordinate = length(kCoordinate)](const Place& place,
                                                                           OutlinePoint& result) {
    const bool is_point = place.value.is_list() && place.value.size() == 4;
    const JsonValue pen = is_point ? place.value.element(0) : JsonValue();
    if (!pen.is("move") && !pen.is("draw")) return place.refuse(allowed);
    result.draw = pen.is("draw");
    bool is_good = coordinate.read(place.element(1), result.p_mm.x);
    is_good = coordinate.read(place.element(2), result.p_mm.y) && is_good;
    return coordinate.read(place.element(3), result.p_mm.z) && is_good;
  };
  codec.write = [](const OutlinePoint& point) {
    return Json::array({point.draw ? "draw" : "move", number_json(point.p_mm.x),
                        number_json(point.p_mm.y), number_json(point.p_mm.z)});
  };
  return codec;
}

}  // namespace

Members<Drive> drive_members(const std::vector<std::string>& names) {
  const Members<Drive> all = {
      required("label", &Drive::label, label()),
      required("precision", &Drive::precision, number({0, kMaxPrecision, true})),
      required("limits", row<Drive>("a list [min, max] of two numbers, the lower first",
                                    number(kVariable), {&Drive::min, &Drive::max})),
      required("speed", &Drive::speed_counts_per_s, whole_number(1, 255)),
      required("direction", &Drive::direction, sign()),
      required("home", &Drive::home, number(kVariable)),
      required("switch", &Drive::microswitch, object(switch_members()))};
  Members<Drive> members;
  for (const std::string& name : names)
    members.push_back(*std::find_if(all.begin(), all.end(),
                                    [&](const auto& member) { return member.name == name; }));
  return members;
}

void convert_lengths(Drive& drive, double mm_per_unit) {
  drive.precision *= mm_per_unit;
  drive.min *= mm_per_unit;
  drive.max *= mm_per_unit;
}

Members<Outline> outline_members() {
  return {required("color", &Outline::color, whole_number(0, kLastColor)),
          required("points", &Outline::points, list(outline_point(), 0, kMaxOutlinePoints))};
}

Members<ToolPart> tool_part_members() {
  const auto pivot = row<PointMm>("a list [x, y, z] of three lengths", length(kCoordinate),
                                  {&PointMm::x, &PointMm::y, &PointMm::z});
  return {required("side", &ToolPart::side, sign()),
          required("color", &ToolPart::color, whole_number(0, kLastColor)),
          optional("pivot", &ToolPart::pivot_mm, pivot),
          required("points", &ToolPart::points, list(outline_point(), 0, kMaxOutlinePoints))};
}

}  // namespace xr3::data
