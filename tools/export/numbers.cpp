#include "tools/export/numbers.hpp"

#include "protocol/scene/colors.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {

std::string number_text(double value) { return plain_number(value, 12); }

std::string numbers_text(const Eigen::Vector3d& values) {
  return number_text(values.x()) + " " + number_text(values.y()) + " " + number_text(values.z());
}

std::string metres_text(const Eigen::Vector3d& mm) { return numbers_text(kMetresPerMm * mm); }

std::string color_text(int color) {
  std::string text;
  for (const std::uint8_t channel : solid_rgb(color))
    text += plain_number(channel / 255.0, 3) + " ";
  return text + "1";
}

}  // namespace xr3
