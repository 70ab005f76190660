#include "protocol/monitor/image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

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

/// A row as a text of 0 and 1.
void append_pixels(const Image& image, int row, std::string& text) {
  const auto words = image.words(row);
  const std::size_t begin = text.size();
  text.resize(begin + words.size() * Image::kWordBits);
  char* next = text.data() + begin;
  for (const std::uint64_t word : words) {
    for (unsigned shift = 0; shift < Image::kWordBits; shift += 8) {
      next = std::copy_n(kEights[word >> shift & 0xffU].data(), 8, next);
    }
  }
  text.resize(begin + static_cast<std::size_t>(image.width()));
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

/// Calls `take` with the length of each run of a row, starting with a run of zeros.
template <class Take>
void each_run(const Image& image, int row, Take take) {
  bool set = false;
  for (int begin = 0; begin < image.width(); set = !set) {
    const int end = run_end(image, row, begin, set);
    take(end - begin);
    begin = end;
  }
}

Json row_json(const Image& image, int row, monitor::Encoding encoding) {
  if (encoding == monitor::Encoding::kRows) {
    std::string pixels;
    append_pixels(image, row, pixels);
    return pixels;
  }
  Json::array_t runs;
  each_run(image, row, [&runs](int length) { runs.emplace_back(length); });
  return runs;
}

void append_row(const Image& image, int row, monitor::Encoding encoding, std::string& text) {
  if (encoding == monitor::Encoding::kRows) {
    text += '"';
    append_pixels(image, row, text);
    text += '"';
    return;
  }
  char before = '[';
  each_run(image, row, [&](int length) {
    text += before + std::to_string(length);
    before = ',';
  });
  text += before == '[' ? "[]" : "]";
}

/// All members of the frame, with empty rows.
Json frame_json(const Image& image, monitor::Encoding encoding) {
  return {{"width", image.width()},
          {"height", image.height()},
          {"encoding", encoding == monitor::Encoding::kRle ? "rle" : "rows"},
          {"rows", Json::array()}};
}

}  // namespace

Json image_json(const Image& image, monitor::Encoding encoding) {
  Json::array_t rows;
  rows.reserve(static_cast<std::size_t>(image.height()));
  for (int row = 0; row < image.height(); ++row) rows.push_back(row_json(image, row, encoding));
  Json members = frame_json(image, encoding);
  members["rows"] = std::move(rows);
  return members;
}

std::string image_text(const Image& image, monitor::Encoding encoding) {
  std::string text = frame_json(image, encoding).dump();
  const auto width = static_cast<std::size_t>(image.width());
  if (encoding == monitor::Encoding::kRows)
    text.reserve(text.size() + static_cast<std::size_t>(image.height()) * (width + 3) +
                 Image::kWordBits);
  text.resize(text.size() - 2);  // up to and including the opening bracket of the rows
  for (int row = 0; row < image.height(); ++row) {
    if (row > 0) text += ',';
    append_row(image, row, encoding, text);
  }
  text += "]}";
  return text;
}

}  // namespace xr3
