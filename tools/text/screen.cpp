#include "tools/text/screen.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace xr3 {
namespace {

constexpr char32_t kUnknown = U'?';

struct LetterRange {
  char32_t first;
  char32_t last;
};
/// Latin, Greek, Cyrillic, dashes and quotation marks, arrows, box drawing and blocks. Excluded are
/// combining marks, characters with two columns in some terminals, and directional marks.
constexpr std::array<LetterRange, 9> kOneColumn{{{0x20, 0x7E},
                                                 {0xA0, 0xAC},
                                                 {0xAE, 0x2FF},
                                                 {0x370, 0x482},
                                                 {0x48A, 0x52F},
                                                 {0x2010, 0x2027},
                                                 {0x2030, 0x205E},
                                                 {0x2190, 0x2199},
                                                 {0x2500, 0x259F}}};

bool is_one_column(char32_t letter) {
  return std::any_of(kOneColumn.begin(), kOneColumn.end(), [letter](const LetterRange& range) {
    return letter >= range.first && letter <= range.last;
  });
}

/// Number of bytes of a UTF-8 sequence with this first byte; 0 if it is invalid.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

/// Removes the first letter from the text and returns it; '?' for invalid UTF-8.
char32_t take_letter(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = length_of(first);
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return kUnknown;
  }
  char32_t letter = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0U) != 0x80) {
      text.remove_prefix(i);
      return kUnknown;
    }
    letter = letter << 6U | (byte & 0x3FU);
  }
  text.remove_prefix(length);
  return letter;
}

void append_utf8(char32_t letter, std::string& text) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  if (letter < 0x80) return add(letter);
  if (letter < 0x800) {
    add(0xC0U | letter >> 6U);
    return add(0x80U | (letter & 0x3FU));
  }
  add(0xE0U | letter >> 12U);
  add(0x80U | (letter >> 6U & 0x3FU));
  add(0x80U | (letter & 0x3FU));
}

}  // namespace

TextScreen::TextScreen(int rows, int columns)
    : rows_(std::max(rows, 1)),
      columns_(std::max(columns, 1)),
      cells_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)) {}

int TextScreen::put(int row, int column, std::string_view text, TextStyle style, int most) {
  std::u32string letters = one_column_letters(text);
  const auto room = static_cast<std::size_t>(std::max(0, std::min(most, columns_ - column)));
  if (letters.size() > room) {
    letters.resize(room);
    if (room > 0) letters.back() = U'…';
  }
  for (const char32_t letter : letters) put_letter(row, column++, letter, style);
  return column;
}

void TextScreen::put_letter(int row, int column, char32_t letter, TextStyle style) {
  if (row < 0 || row >= rows_ || column < 0 || column >= columns_) return;
  cells_[index(row, column)] = {letter, style};
}

std::u32string one_column_letters(std::string_view text) {
  std::u32string letters;
  while (!text.empty()) {
    const char32_t letter = take_letter(text);
    letters += is_one_column(letter) ? letter : kUnknown;
  }
  return letters;
}

char32_t in_letters(char32_t letter, Letters letters) {
  static const std::map<char32_t, char32_t> alike{
      {U'█', U'#'}, {U'▀', U'"'}, {U'▄', U'_'}, {U'▉', U'#'}, {U'▊', U'#'}, {U'▋', U'#'},
      {U'▌', U'#'}, {U'▍', U' '}, {U'▎', U' '}, {U'▏', U' '}, {U'─', U'-'}, {U'│', U'|'},
      {U'·', U'.'}, {U'…', U'~'}, {U'×', U'x'}, {U'–', U'-'}, {U'−', U'-'}, {U'’', U'\''}};
  if (letters == Letters::kUnicode || letter < 0x7F) return letter;
  const auto found = alike.find(letter);
  return found == alike.end() ? kUnknown : found->second;
}

std::string text_of(const TextScreen& screen, Letters letters) {
  std::string text;
  std::size_t end = 0;  // after the last row that is not blank
  for (int row = 0; row < screen.rows(); ++row) {
    for (int column = 0; column < screen.columns(); ++column) {
      append_utf8(in_letters(screen.at(row, column).letter, letters), text);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    const bool is_blank = text.empty() || text.back() == '\n';
    text += '\n';
    if (!is_blank) end = text.size();
  }
  return text.substr(0, end);
}

}  // namespace xr3
