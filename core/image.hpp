// A binary image, as the camera takes it: a plain value of packed bits. Independent of blocks,
// units and formats.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace xr3 {

/// Columns are numbered from the left, rows from the top, both from 0.
class Image {
 public:
  /// All pixels are 0. Precondition: width and height are not negative.
  Image(int width, int height)
      : width_(width),
        height_(height),
        words_a_row_((static_cast<std::size_t>(width) + kBits - 1) / kBits),
        words_(words_a_row_ * static_cast<std::size_t>(height)) {
    assert(width >= 0 && height >= 0);
  }

  int width() const { return width_; }
  int height() const { return height_; }

  /// Precondition: the pixel is within the image.
  bool at(int column, int row) const {
    assert(column >= 0 && column < width_ && row >= 0 && row < height_);
    return (word(column, row) >> (static_cast<unsigned>(column) % kBits) & 1U) != 0;
  }

  /// The pixels of a row from the left.
  std::vector<bool> row(int row) const {
    std::vector<bool> pixels(static_cast<std::size_t>(width_));
    for (int column = 0; column < width_; ++column) {
      pixels[static_cast<std::size_t>(column)] = at(column, row);
    }
    return pixels;
  }

  /// The pixels of a row, kWordBits per word, the leftmost in the lowest bit; bits after the last
  /// pixel are 0.
  std::span<const std::uint64_t> words(int row) const {
    return {words_.data() + static_cast<std::size_t>(row) * words_a_row_, words_a_row_};
  }
  static constexpr int kWordBits = 64;

  /// Calls fill(std::span<std::uint64_t>) for the words of a row; bits after the last pixel are
  /// then set to 0.
  template <class Fill>
  void set_words(int row, const Fill& fill) {
    const std::span<std::uint64_t> words(&word(0, row), words_a_row_);
    fill(words);
    words.back() &= kAll >> (kBits - 1 - static_cast<unsigned>(width_ - 1) % kBits);
  }

  /// One row as an image one pixel high.
  Image row_image(int row) const {
    Image cut(width_, 1);
    std::copy(words(row).begin(), words(row).end(), cut.words_.begin());
    return cut;
  }

  /// Sets the pixels begin <= column < end of a row; none if end <= begin. Precondition: 0 <= begin
  /// and end <= width.
  void fill(int row, int begin, int end) {
    assert(row >= 0 && row < height_ && begin >= 0 && end <= width_);
    if (end <= begin) return;
    std::uint64_t* const first = &word(begin, row);
    std::uint64_t* const last = &word(end - 1, row);
    const std::uint64_t from_begin = kAll << static_cast<unsigned>(begin) % kBits;
    const std::uint64_t to_end = kAll >> (kBits - 1 - static_cast<unsigned>(end - 1) % kBits);
    if (first == last) {
      *first |= from_begin & to_end;
      return;
    }
    *first |= from_begin;
    std::fill(first + 1, last, kAll);
    *last |= to_end;
  }

  bool operator==(const Image&) const = default;

 private:
  static constexpr unsigned kBits = kWordBits;
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * words_a_row_ + static_cast<unsigned>(column) / kBits;
  }
  std::uint64_t word(int column, int row) const { return words_[index(column, row)]; }
  std::uint64_t& word(int column, int row) { return words_[index(column, row)]; }

  int width_;
  int height_;
  std::size_t words_a_row_;
  std::vector<std::uint64_t> words_;  ///< each row starts a new word; see words()
};

/// A shared, immutable image.
using ImagePtr = std::shared_ptr<const Image>;

}  // namespace xr3
