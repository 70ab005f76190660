#include "protocol/files/drive.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace xr3::data {
namespace {

constexpr double kMaxVariable = 1e6;
constexpr double kMaxPrecision = 1000;
constexpr int kMaxSwitchCounts = 1000000;

/// In degrees or in the file's length unit, depending on the kind of joint or tool.
const Range kVariable{-kMaxVariable, kMaxVariable};

Codec<char> label() {
  Codec<char> codec;
  codec.allowed = "a letter \"A\" to \"H\"";
  codec.read = [allowed = codec.allowed](const Place& place, char& result) {
    const std::string letters = place.value.is_text() ? place.value.text(2) : "";
    if (letters.size() != 1 || letters[0] < 'A' || letters[0] > 'H') return place.refuse(allowed);
    return result = letters[0], true;
  };
  codec.write = [](const char& letter) { return Json(std::string(1, letter)); };
  return codec;
}

/// One of the six bits of a reply, or none.
Codec<std::uint8_t> mask() {
  Codec<std::uint8_t> codec;
  codec.allowed = "1, 2, 4, 8, 16 or 32, or 0 for none";
  codec.read = [allowed = codec.allowed](const Place& place, std::uint8_t& result) {
    for (const int bits : {0, 1, 2, 4, 8, 16, 32}) {
      if (place.value.is(bits)) return result = static_cast<std::uint8_t>(bits), true;
    }
    return place.refuse(allowed);
  };
  codec.write = [](const std::uint8_t& bits) { return Json(bits); };
  return codec;
}

Members<Microswitch> switch_members() {
  return {required("position", &Microswitch::position,
                   whole_number(-kMaxSwitchCounts, kMaxSwitchCounts)),
          required("mask", &Microswitch::mask, mask()),
          optional("width", &Microswitch::width, whole_number(1, kMaxSwitchCounts))};
}

}  // namespace

Codec<int> sign() {
  Codec<int> codec;
  codec.allowed = "1 or -1";
  codec.read = [](const Place& place, int& result) {
    const bool is_good = place.value.is(1) || place.value.is(-1);
    if (!is_good) return place.refuse("1 or -1");
    return result = place.value.is(1) ? 1 : -1, true;
  };
  codec.write = [](const int& value) { return Json(value); };
  return codec;
}

Member<Drive> limits_member() {
  const std::string allowed = "a list [min, max] of two numbers, the lower first";
  Member<Drive> member;
  member.name = "limits";
  member.allowed = allowed;
  member.read = [allowed, bound = number(kVariable)](const Place& place, Drive& drive) {
    if (!place.value.is_list() || place.value.size() != 2) return place.refuse(allowed);
    const bool has_min = bound.read(place.element(0), drive.min);
    return bound.read(place.element(1), drive.max) && has_min;
  };
  member.write = [](const Drive& drive) {
    return Json::array({number_json(drive.min), number_json(drive.max)});
  };
  return member;
}

Member<Drive> label_member() { return required("label", &Drive::label, label()); }
Member<Drive> precision_member() {
  return required("precision", &Drive::precision, number({0, kMaxPrecision, true}));
}
Member<Drive> speed_member() {
  return required("speed", &Drive::speed_counts_per_s, whole_number(1, 255));
}
Member<Drive> direction_member() { return required("direction", &Drive::direction, sign()); }
Member<Drive> home_member() { return required("home", &Drive::home, number(kVariable)); }
Member<Drive> switch_member() {
  return required("switch", &Drive::microswitch, object(switch_members()));
}

void convert_lengths(Drive& drive, double mm_per_unit) {
  drive.precision *= mm_per_unit;
  drive.min *= mm_per_unit;
  drive.max *= mm_per_unit;
}

}  // namespace xr3::data
