#include "tools/drawing/svg.hpp"

#include <cmath>
#include <string_view>

#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

/// The number rounded to hundredths, without trailing zeros.
std::string number(double value) {
  const auto hundredths = static_cast<long long>(std::llround(std::abs(value) * 100));
  std::string text = value < 0 && hundredths != 0 ? "-" : "";
  text += std::to_string(hundredths / 100);
  const auto rest = hundredths % 100;
  if (rest != 0) text += "." + std::to_string(rest / 10);
  if (rest % 10 != 0) text += std::to_string(rest % 10);
  return text;
}

std::string quoted(const std::string& name, std::string_view value) {
  return " " + name + "=\"" + xml(value) + "\"";
}

std::string steps(const FlatWire& wire) {
  std::string path;
  for (const Eigen::Vector2d& p : wire.points) {
    path += (path.empty() ? "M" : "L") + number(p.x()) + " " + number(p.y());
  }
  return path;
}

std::string path_tag(const FlatWire& wire, const std::string& path, Background background) {
  return "<path" + quoted("data-part", wire.part) +
         quoted("stroke", color_hex(wire.color, background)) +
         quoted("stroke-width", number(line_width_px(wire.part))) + quoted("d", path) + "/>\n";
}

std::string head(const Picture& picture) {
  const std::string width = std::to_string(picture.width_px);
  const std::string height = std::to_string(picture.height_px);
  const bool is_light = picture.background == Background::kLight;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + quoted("width", width) +
         quoted("height", height) + quoted("viewBox", "0 0 " + width + " " + height) + ">\n" +
         "<title>" + xml(picture.title) + "</title>\n" + "<rect width=\"100%\" height=\"100%\"" +
         quoted("fill", is_light ? "#ffffff" : "#14171c") +
         "/>\n<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
}

}  // namespace

std::string to_svg(const Picture& picture) {
  std::string text = head(picture);
  std::string path;
  for (std::size_t i = 0; i < picture.wires.size(); ++i) {
    const FlatWire& wire = picture.wires[i];
    path += steps(wire);
    const bool goes_on = i + 1 < picture.wires.size() && picture.wires[i + 1].part == wire.part &&
                         picture.wires[i + 1].color == wire.color;
    if (goes_on) continue;
    text += path_tag(wire, path, picture.background);
    path.clear();
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace xr3
