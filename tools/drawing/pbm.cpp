#include "tools/drawing/pbm.hpp"

namespace xr3 {

std::string to_pbm(const Image& image) {
  std::string text =
      "P1\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n";
  text.reserve(text.size() + static_cast<std::size_t>(image.width() + 1) *
                                 static_cast<std::size_t>(image.height()));
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column)
      text.push_back(image.at(column, row) ? '1' : '0');
    text.push_back('\n');
  }
  return text;
}

}  // namespace xr3
