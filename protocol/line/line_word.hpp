// Finds lines that consist of a word such as HELP or QUIT. The controller has no words: it has
// executed each letter as a command, and its user wonders at what happened. docs/protocol.md says
// why these words. A value of a few bytes that changes nothing but warnings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/line/parsed.hpp"

namespace xr3 {

class LineWord {
 public:
  /// Handles the byte at `offset` of the line's input. Returns a problem with the bytes of the line
  /// if the byte ends a line that is one of the words, in capital or small letters. Blanks before
  /// the word are skipped.
  std::optional<Parsed> feed(std::uint8_t byte, std::uint64_t offset);

  bool operator==(const LineWord&) const = default;

 private:
  static constexpr std::size_t kMaxLetters = 7;
  static constexpr std::uint8_t kNoWord = kMaxLetters + 1;

  std::optional<Parsed> end(std::uint8_t byte, std::uint64_t offset) const;
  std::string_view letters() const { return {letters_.data(), size_}; }

  std::uint64_t from_ = 0;  ///< offset of the first letter
  std::array<char, kMaxLetters> letters_{};
  std::uint8_t size_ = 0;  ///< number of letters; kNoWord: no word begins as the line does
};

}  // namespace xr3
