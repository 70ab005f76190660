#include "tools/watch/panels.hpp"

#include <algorithm>

#include "protocol/text/table.hpp"

namespace xr3::watch {
namespace {

constexpr int kBlockName = 10;  ///< columns for a block's name and a blank

/// One character per line: its number if it is high, a dot if it is low.
std::string lines_text(const std::vector<bool>& lines) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += lines[i] ? std::to_string(i + 1) : std::string("·");
  }
  return text;
}

/// A number right-aligned in `columns` columns.
std::string right(double number, std::size_t columns) {
  const std::string text = fixed_number(number, 1);
  return text.size() < columns ? std::string(columns - text.size(), ' ') + text : " " + text;
}

void paint_block(TextScreen& screen, int row, const TextArea& area, const WatchedBlock& block) {
  constexpr std::size_t kColumn = 8;
  const TextStyle style = block.is_held ? TextStyle::kGood : TextStyle::kPlain;
  const int name = std::min(kBlockName, area.columns);
  screen.put(row, area.column, block.name, style, name - 1);
  std::string text;
  for (const double mm : block.xyz_mm) text += right(mm, kColumn);
  text += right(block.yaw_deg, kColumn) + (block.is_held ? " held" : "");
  screen.put(row, area.column + name, text, style, area.columns - name);
}

/// If not all blocks fit, the last row shows the number of the others.
void paint_blocks(TextScreen& screen, const TextArea& area,
                  const std::vector<WatchedBlock>& blocks) {
  const auto rows = static_cast<std::size_t>(std::max(area.rows, 0));
  const std::size_t shown =
      blocks.size() <= rows ? blocks.size() : rows - std::min<std::size_t>(rows, 1);
  for (std::size_t i = 0; i < shown; ++i) {
    paint_block(screen, area.row + static_cast<int>(i), area, blocks[i]);
  }
  if (shown == blocks.size() || rows == 0) return;
  screen.put(area.row + area.rows - 1, area.column,
             "and " + std::to_string(blocks.size() - shown) + " more", TextStyle::kFaint,
             area.columns);
}

TextStyle style_of(const Note& note) {
  if (note.kind == "stalled") return TextStyle::kBad;
  const bool is_warning = note.kind == "warning" || note.kind == "blocked" || note.kind == "fault";
  return is_warning ? TextStyle::kWarning : TextStyle::kPlain;
}

void paint_note(TextScreen& screen, int row, const TextArea& area, const Known& known,
                const Note& note) {
  constexpr std::size_t kTimeWidth = 12;
  const std::string time = seconds_text(note.tick, known.tick_hz);
  const std::string indent(kTimeWidth - std::min(kTimeWidth, time.size()), ' ');
  const int end = area.column + area.columns;
  const int at =
      screen.put(row, area.column, indent + time + "  ", TextStyle::kFaint, area.columns);
  const bool names_its_line = note.message.starts_with("line ");
  std::string text =
      note.line && !names_its_line ? "line " + std::to_string(*note.line) + ": " : "";
  text += note.message.empty() ? note.kind : note.message;
  if (note.times > 1) text += " (" + std::to_string(note.times) + " times)";
  screen.put(row, at, text, style_of(note), end - at);
}

/// The half block for an upper and a lower pixel.
char32_t half_block(bool upper, bool lower) {
  if (upper && lower) return U'█';
  if (upper) return U'▀';
  return lower ? U'▄' : U' ';
}

bool is_third_set(const WatchedImage& image, std::size_t x0, std::size_t x1, std::size_t y0,
                  std::size_t y1) {
  std::size_t set = 0;
  for (std::size_t y = y0; y < y1; ++y) {
    for (std::size_t x = x0; x < x1; ++x) set += image.at(x, y) ? 1U : 0U;
  }
  return set * 3 >= (x1 - x0) * (y1 - y0) && set > 0;
}

}  // namespace

std::string seconds_text(std::int64_t tick, std::int64_t tick_hz) {
  return fixed_number(static_cast<double>(tick) / static_cast<double>(tick_hz), 3) + " s";
}

ImageSize shrunk_size(const WatchedImage& image, std::size_t most_columns, std::size_t most_rows) {
  const std::size_t by_height = image.width * most_rows / image.height;
  const std::size_t width =
      std::max<std::size_t>(std::min({image.width, most_columns, by_height}), 1);
  const std::size_t height = image.height * width / image.width;
  return {width, std::clamp<std::size_t>(height, 1, std::max<std::size_t>(most_rows, 1))};
}

WatchedImage shrunk(const WatchedImage& image, std::size_t most_columns, std::size_t most_rows) {
  const ImageSize size = shrunk_size(image, most_columns, most_rows);
  WatchedImage small{size.width, size.height, {}};
  const auto edge = [](std::size_t i, std::size_t from, std::size_t to) { return i * from / to; };
  for (std::size_t y = 0; y < small.height; ++y) {
    for (std::size_t x = 0; x < small.width; ++x) {
      small.pixels.push_back(is_third_set(
          image, edge(x, image.width, small.width), edge(x + 1, image.width, small.width),
          edge(y, image.height, small.height), edge(y + 1, image.height, small.height)));
    }
  }
  return small;
}

void paint_rule(TextScreen& screen, const TextArea& area, const std::string& name) {
  for (int i = 0; i < area.columns; ++i) {
    screen.put_letter(area.row, area.column + i, U'─', TextStyle::kRule);
  }
  screen.put(area.row, area.column + 2, " " + name + " ", TextStyle::kRule, area.columns - 2);
}

void paint_tool(TextScreen& screen, const TextArea& area, const WatchedState& state) {
  const WatchedTool& tool = state.tool;
  const auto& xyz = tool.xyz_mm;
  const std::string text = "tool " + tool.axis.label + "  opening " +
                           fixed_number(tool.opening_mm, 1) + " mm  tip x" + right(xyz[0], 7) +
                           "  y" + right(xyz[1], 7) + "  z" + right(xyz[2], 7) + " mm  holds ";
  const int end = area.column + area.columns;
  const int at = screen.put(area.row, area.column, text, TextStyle::kPlain, area.columns);
  const bool holds = !tool.holding.empty();
  screen.put(area.row, at, holds ? tool.holding : "nothing",
             holds ? TextStyle::kGood : TextStyle::kFaint, end - at);
}

void paint_blocks_and_lines(TextScreen& screen, const TextArea& area, const WatchedState& state) {
  if (area.rows < 1) return;
  const std::string lines = "inputs " + lines_text(state.inputs) + "  outputs " +
                            lines_text(state.outputs) + "  aux " + lines_text(state.aux);
  const bool has_blocks = !state.blocks.empty() && area.rows > 2;
  const int rows = has_blocks ? std::min(area.rows - 2, static_cast<int>(state.blocks.size())) : 0;
  paint_rule(screen, area, has_blocks ? "blocks   x mm    y mm    z mm yaw deg" : "lines");
  if (has_blocks) {
    paint_blocks(screen, {area.row + 1, area.column, rows, area.columns}, state.blocks);
  }
  if (area.rows < 2) return;
  screen.put(area.row + rows + 1, area.column, lines, TextStyle::kPlain, area.columns);
}

void paint_notes(TextScreen& screen, const TextArea& area, const Known& known) {
  paint_rule(screen, area, "events");
  const auto room = static_cast<std::size_t>(std::max(area.rows - 1, 0));
  const std::size_t shown = std::min(room, known.notes.size());
  auto note = std::prev(known.notes.end(), static_cast<std::ptrdiff_t>(shown));
  for (int row = area.row + 1; note != known.notes.end(); ++note, ++row) {
    paint_note(screen, row, area, known, note->second);
  }
}

void paint_image(TextScreen& screen, const TextArea& area, const WatchedImage& image) {
  paint_rule(screen, area,
             "camera " + std::to_string(image.width) + " x " + std::to_string(image.height));
  const int rows = area.rows - 1;
  if (rows < 1 || area.columns < 1) return;
  const WatchedImage small =
      shrunk(image, static_cast<std::size_t>(area.columns), 2 * static_cast<std::size_t>(rows));
  for (std::size_t y = 0; y < small.height; y += 2) {
    for (std::size_t x = 0; x < small.width; ++x) {
      const bool lower = y + 1 < small.height && small.at(x, y + 1);
      screen.put_letter(area.row + 1 + static_cast<int>(y / 2), area.column + static_cast<int>(x),
                        half_block(small.at(x, y), lower), TextStyle::kPicture);
    }
  }
}

}  // namespace xr3::watch
