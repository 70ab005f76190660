#include "protocol/image_json.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>

namespace xr3 {
namespace {

using Eight = std::array<char, 8>;

/// Eight pixels as text, the lowest bit first.
constexpr std::array<Eight, 256> eights() {
  std::array<Eight, 256> table{};
  for (unsigned bits = 0; bits < table.size(); ++bits) {
    for (unsigned i = 0; i < 8; ++i) table[bits][i] = (bits >> i & 1U) != 0 ? '1' : '0';
  }
  return table;
}
constexpr std::array<Eight, 256> kEights = eights();

std::string row_text(const Image& image, int row) {
  std::string text;
  text.reserve(static_cast<std::size_t>(image.width()) + Image::kWordBits);
  for (const std::uint64_t word : image.words(row)) {
    for (int shift = 0; shift < Image::kWordBits; shift += 8) {
      const Eight& eight = kEights[word >> static_cast<unsigned>(shift) & 0xffU];
      text.append(eight.data(), eight.size());
    }
  }
  text.resize(static_cast<std::size_t>(image.width()));
  return text;
}

/// The first column from `begin` on whose pixel is not `set`, or the width.
int run_end(const Image& image, int row, int begin, bool set) {
  const auto words = image.words(row);
  while (begin < image.width()) {
    const auto index = static_cast<std::size_t>(begin / Image::kWordBits);
    const int within = begin % Image::kWordBits;
    const std::uint64_t others =
        (set ? ~words[index] : words[index]) >> static_cast<unsigned>(within);
    if (others != 0) return std::min(image.width(), begin + std::countr_zero(others));
    begin += Image::kWordBits - within;
  }
  return image.width();
}

Json row_runs(const Image& image, int row) {
  Json runs = Json::array();
  bool set = false;
  for (int begin = 0; begin < image.width(); set = !set) {
    const int end = run_end(image, row, begin, set);
    runs.push_back(end - begin);
    begin = end;
  }
  return runs;
}

}  // namespace

Json image_json(const Image& image, monitor::Encoding encoding) {
  const bool is_rle = encoding == monitor::Encoding::kRle;
  Json rows = Json::array();
  for (int row = 0; row < image.height(); ++row) {
    rows.push_back(is_rle ? row_runs(image, row) : Json(row_text(image, row)));
  }
  return {{"width", image.width()},
          {"height", image.height()},
          {"encoding", is_rle ? "rle" : "rows"},
          {"rows", std::move(rows)}};
}

}  // namespace xr3
