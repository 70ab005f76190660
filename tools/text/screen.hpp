// A screen of text: cells in rows and columns, each with one letter and a style. Text is cut at the
// edges, and every character that may not be exactly one column wide is replaced, so that no text
// from outside can move the terminal's cursor. Independent of the terminal.
//
// The flow through the folder: a painter, such as the screen of `xr3 watch`
// (tools/watch/screen.hpp), makes a TextScreen of the terminal's size and calls put() for each text
// with its row, column, style and the columns that it may take. Names from the network are
// arbitrary bytes: put() decodes UTF-8, drops what is outside the screen and ends a cut text with
// an ellipsis; invalid bytes and letters without a width of one column become `?`. The caller shows
// the finished screen cell by cell with ncurses (cli/term/terminal.hpp), or prints text_of() as
// plain rows when standard output is no terminal. in_letters() replaces box drawing and blocks by
// ASCII for terminals that have nothing else. markup.hpp is independent of screens: it escapes text
// for HTML and XML, for the reports of tools/report and the pictures of tools/drawing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

/// The meaning of a letter; the terminal decides its appearance.
enum class TextStyle : std::uint8_t {
  kPlain,
  kFaint,
  kStrong,
  kTitle,  ///< rows at the upper and lower edge
  kRule,   ///< lines between parts, with the parts' names
  kGood,
  kWarning,
  kBad,
  kPicture,  ///< a camera's pixels; set pixels in the foreground colour
};

struct TextCell {
  char32_t letter = U' ';
  TextStyle style = TextStyle::kPlain;
  bool operator==(const TextCell&) const = default;
};

/// A rectangle of cells. Rows and columns count from 0 at the upper left corner.
struct TextArea {
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
};

/// The letters that the terminal can show.
enum class Letters : std::uint8_t { kUnicode, kAscii };

class TextScreen {
 public:
  /// A blank screen with at least one row and one column.
  TextScreen(int rows, int columns);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  TextArea area() const { return {0, 0, rows_, columns_}; }
  const TextCell& at(int row, int column) const { return cells_[index(row, column)]; }

  /// Puts UTF-8 text into at most `most` columns; cut text ends with an ellipsis. Letters outside
  /// the screen are dropped. Returns the column after the text.
  int put(int row, int column, std::string_view text, TextStyle style, int most);
  /// Puts one letter, which must be one column wide. Ignored outside the screen.
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

/// The letters of a UTF-8 text. Letters that are not one column wide and invalid bytes become '?'.
std::u32string one_column_letters(std::string_view text);

/// The letter, or for kAscii the most similar ASCII letter.
char32_t in_letters(char32_t letter, Letters letters);

/// The rows in UTF-8, each with a line feed, without trailing blanks and without trailing blank
/// rows.
std::string text_of(const TextScreen& screen, Letters letters);

}  // namespace xr3
