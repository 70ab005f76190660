#include "tools/drawing/pbm.hpp"

namespace xr3 {

std::string to_pbm(const Image& image) {
  std::string text =
      "P1\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n";
  for (int row = 0; row < image.height(); ++row) {
    for (const bool pixel : image.row(row)) text += pixel ? '1' : '0';
    text += '\n';
  }
  return text;
}

}  // namespace xr3
