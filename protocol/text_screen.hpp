// A screen of text: cells in rows and columns, each one letter in one style. What is put there is cut
// at its edges and cleaned of all that is not surely one column wide, so that no text from elsewhere
// can move a terminal's cursor. It knows no terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

/// What a letter means; a terminal decides how that looks.
enum class TextStyle : std::uint8_t {
  kPlain,
  kFaint,
  kStrong,
  kTitle,  ///< rows at the upper and lower edge
  kRule,   ///< lines between parts, and what they are called
  kGood,
  kWarning,
  kBad,
  kPicture,  ///< a camera's pixels, set ones in front
};

struct TextCell {
  char32_t letter = U' ';
  TextStyle style = TextStyle::kPlain;
  bool operator==(const TextCell&) const = default;
};

/// Rows and columns, counted from 0 at the left upper corner.
struct TextArea {
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
};

/// Which letters may be used.
enum class Letters : std::uint8_t { kUnicode, kAscii };

class TextScreen {
 public:
  /// Blank. At least one row and column are there, whatever was asked for.
  TextScreen(int rows, int columns);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  TextArea area() const { return {0, 0, rows_, columns_}; }
  const TextCell& at(int row, int column) const { return cells_[index(row, column)]; }

  /// Puts UTF-8 from there to the right, no further than `most` columns; text that is cut ends in
  /// an ellipsis. Returns the column behind it. What lies outside is left out.
  int put(int row, int column, std::string_view text, TextStyle style, int most);
  /// One letter, as it is.
  void put_letter(int row, int column, char32_t letter, TextStyle style);

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int rows_;
  int columns_;
  std::vector<TextCell> cells_;
};

/// The letters of UTF-8, each one column wide: others, and bytes that are no UTF-8, become '?'.
std::u32string one_column_letters(std::string_view text);

/// The same letter, or the ASCII one that looks most like it.
char32_t in_letters(char32_t letter, Letters letters);

/// The rows without blanks at their ends, each with a line feed, in UTF-8; no blank rows at the end.
std::string text_of(const TextScreen& screen, Letters letters);

}  // namespace xr3
