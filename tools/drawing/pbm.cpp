#include "tools/drawing/pbm.hpp"

namespace xr3 {

std::string to_pbm(const Image& image) {
  std::string text =
      "P1\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n";
  text.reserve(text.size() + static_cast<std::size_t>(image.width() + 1) *
                                 static_cast<std::size_t>(image.height()));
  for (int row = 0; row < image.height(); ++row) {
    const auto words = image.words(row);
    for (unsigned column = 0; column < static_cast<unsigned>(image.width()); ++column) {
      const std::uint64_t word = words[column / Image::kWordBits];
      text.push_back((word >> column % Image::kWordBits & 1U) != 0 ? '1' : '0');
    }
    text.push_back('\n');
  }
  return text;
}

}  // namespace xr3
