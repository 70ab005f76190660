// The page of serial lines: one row each, the physical controller first.
#include <algorithm>
#include <array>

#include "tools/watch/panels.hpp"

namespace xr3::watch {
namespace {

constexpr std::size_t kLineColumns = 8;
using LineCells = std::array<std::string, kLineColumns>;
using LineWidths = std::array<int, kLineColumns>;

/// A column is as wide as its widest cell, up to `max`, and left out if it is empty. If room is
/// short, the columns of the highest rank are left out first; rank 0 is never left out.
struct LineColumn {
  const char* name;
  int max;
  bool is_right;
  int rank;
};
constexpr std::array<LineColumn, kLineColumns> kLineTable{{{"line", 10, true, 0},
                                                           {"kind", 7, false, 0},
                                                           {"peer", 48, false, 1},
                                                           {"age", 12, true, 4},
                                                           {"in", 16, true, 2},
                                                           {"out", 16, true, 2},
                                                           {"settings", 21, false, 5},
                                                           {"last", 24, false, 3}}};

std::string age_of(const LineEntry& line, const Known& known) {
  if (!line.opened) return "not there";
  return age_text((known.tick - *line.opened) / known.tick_hz);
}

LineCells cells_of(const LineEntry& line, const Known& known) {
  return {line.number ? std::to_string(*line.number) : "",
          line.kind,
          line.peer,
          age_of(line, known),
          std::to_string(line.bytes_in),
          std::to_string(line.bytes_out),
          line.settings,
          line.last};
}

int letters_in(const std::string& text) {
  return static_cast<int>(one_column_letters(text).size());
}

/// The first row is the heading.
LineWidths natural_widths(const std::vector<LineCells>& rows) {
  LineWidths widths{};
  for (std::size_t i = 0; i < kLineColumns; ++i) {
    int& width = widths.at(i);
    for (std::size_t row = 1; row < rows.size(); ++row)
      width = std::max(width, letters_in(rows[row].at(i)));
    if (width > 0)
      width = std::min(std::max(width, letters_in(rows[0].at(i))), kLineTable.at(i).max);
  }
  return widths;
}

/// The total width, with two blanks between neighbours. A width of 0 is a column that is left out.
int total_of(const LineWidths& widths) {
  int total = -2;
  for (const int width : widths) total += width == 0 ? 0 : width + 2;
  return total;
}

LineWidths fitting_widths(const std::vector<LineCells>& rows, int columns) {
  LineWidths widths = natural_widths(rows);
  for (int rank = 5; rank > 0 && total_of(widths) > columns; --rank) {
    for (std::size_t i = 0; i < kLineColumns; ++i)
      if (kLineTable.at(i).rank == rank) widths.at(i) = 0;
  }
  return widths;
}

void paint_cells(TextScreen& screen, int at, int from, const LineCells& cells,
                 const LineWidths& widths, TextStyle style) {
  for (std::size_t i = 0; i < kLineColumns; ++i) {
    const int width = widths.at(i);
    if (width == 0) continue;
    const int indent = kLineTable.at(i).is_right ? std::max(0, width - letters_in(cells.at(i))) : 0;
    screen.put(at, from + indent, cells.at(i), style, width - indent);
    from += width + 2;
  }
}

LineCells heading_cells() {
  LineCells names;
  for (std::size_t i = 0; i < kLineColumns; ++i) names.at(i) = kLineTable.at(i).name;
  return names;
}

TextStyle style_of(const LineEntry& line) {
  if (!line.opened) return TextStyle::kBad;
  return line.number ? TextStyle::kPlain : TextStyle::kStrong;
}

}  // namespace

// A duration rounded down, with the two largest units.
std::string age_text(std::int64_t seconds) {
  constexpr std::int64_t kMinute = 60;
  constexpr std::int64_t kHour = 60 * kMinute;
  constexpr std::int64_t kDay = 24 * kHour;
  const auto two = [seconds](std::int64_t large, const char* name, std::int64_t small,
                             const char* small_name) {
    return std::to_string(seconds / large) + " " + name + " " +
           std::to_string(seconds % large / small) + " " + small_name;
  };
  if (seconds < kMinute) return std::to_string(std::max<std::int64_t>(seconds, 0)) + " s";
  if (seconds < kHour) return two(kMinute, "min", 1, "s");
  return seconds < kDay ? two(kHour, "h", kMinute, "min") : two(kDay, "d", kHour, "h");
}

void paint_serial_lines(TextScreen& screen, const TextArea& area, const Known& known,
                        const std::vector<LineEntry>& lines) {
  std::vector<LineCells> rows{heading_cells()};
  for (const LineEntry& line : lines) rows.push_back(cells_of(line, known));
  const LineWidths widths = fitting_widths(rows, area.columns);
  const auto room = static_cast<std::size_t>(std::max(area.rows, 0));
  const bool is_cut = rows.size() > room;
  const std::size_t shown = is_cut ? room - std::min<std::size_t>(room, 1) : rows.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const TextStyle style = i == 0 ? TextStyle::kFaint : style_of(lines[i - 1]);
    paint_cells(screen, area.row + static_cast<int>(i), area.column, rows[i], widths, style);
  }
  if (!is_cut || room == 0) return;
  screen.put(area.row + area.rows - 1, area.column,
             "and " + std::to_string(rows.size() - std::max<std::size_t>(shown, 1)) + " more",
             TextStyle::kFaint, area.columns);
}

}  // namespace xr3::watch
