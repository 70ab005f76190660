#include "protocol/goals/goal_text.hpp"

#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

std::string range_text(char axis, Micrometres low, Micrometres high) {
  return std::string(1, axis) + " " + mm_text(low) + " to " + mm_text(high);
}

}  // namespace

std::string mm_text(Micrometres length) { return plain_number(mm(length), 1); }

std::string degrees_text(Microdegrees angle) { return plain_number(degrees(angle), 1); }

std::string seconds_text(Tick ticks) {
  return plain_number(static_cast<double>(ticks) / kTickHz, 3);
}

std::string point_text(const PointUm& point) {
  return point_text(PartialPoint{point.x, point.y, point.z});
}

std::string point_text(const PartialPoint& point) {
  std::string text;
  const auto add = [&](const char* axis, const std::optional<Micrometres>& at) {
    if (at) text += (text.empty() ? "" : ", ") + std::string(axis) + " " + mm_text(*at);
  };
  add("x", point.x);
  add("y", point.y);
  add("z", point.z);
  return text + " mm";
}

std::string box_text(const BoxUm& box) {
  return range_text('x', box.low.x, box.high.x) + ", " + range_text('y', box.low.y, box.high.y) +
         ", " + range_text('z', box.low.z, box.high.z) + " mm";
}

std::string names_text(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace xr3
