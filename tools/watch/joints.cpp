// The table of joints: one row each, with a bar that shows the position between the limits.
#include <algorithm>
#include <cmath>
#include <functional>

#include "protocol/text/table.hpp"
#include "tools/watch/panels.hpp"

namespace xr3::watch {
namespace {

constexpr int kMaxBarLength = 64;
constexpr int kEighths = 8;
constexpr char32_t kFullBlock = U'█';
/// The code point of the block with the left n eighths filled is kFullBlock + 8 - n; n = 1...7.
constexpr char32_t eighths_block(int eighths) {
  return kFullBlock + static_cast<char32_t>(kEighths - eighths);
}

/// An axis with its limits, if they are known.
struct JointRow {
  const Axis& axis;
  std::optional<VariableRange> limits;
};

/// A column of the table. If room is short, the columns with the highest `rank` are dropped first;
/// rank 0 is never dropped.
struct JointColumn {
  enum class Alignment : std::uint8_t { kLeft, kRight, kBar };
  std::string name;
  int width;
  Alignment kind;
  int rank;
  std::function<std::string(const JointRow&)> text;
};

/// Pads "mm" to the width of "deg", so that decimal points line up.
std::string value_text(const Axis& axis) {
  return fixed_number(axis.value, 2) + " " + axis.unit + (axis.unit.size() < 3 ? " " : "");
}

std::string state_text(const Axis& axis) {
  if (!axis.blocked.empty()) return axis.blocked;
  return axis.is_moving ? "moves" : "rests";
}

std::vector<JointColumn> all_columns() {
  using Alignment = JointColumn::Alignment;
  const auto limit = [](double VariableRange::*end) {
    return [end](const JointRow& row) {
      return row.limits ? plain_number((*row.limits).*end, 1) : "";
    };
  };
  return {
      {"", 1, Alignment::kLeft, 0, [](const JointRow& row) { return row.axis.label; }},
      {"from", 7, Alignment::kRight, 8, limit(&VariableRange::min)},
      {"", kMinBarLength, Alignment::kBar, 4, {}},
      {"to", 7, Alignment::kLeft, 8, limit(&VariableRange::max)},
      {"value", 13, Alignment::kRight, 0, [](const JointRow& row) { return value_text(row.axis); }},
      {"count", 7, Alignment::kRight, 1,
       [](const JointRow& row) { return std::to_string(row.axis.count); }},
      {"error", 5, Alignment::kRight, 3,
       [](const JointRow& row) { return std::to_string(row.axis.error); }},
      {"speed", 5, Alignment::kRight, 6,
       [](const JointRow& row) { return std::to_string(row.axis.speed); }},
      {"switch", 6, Alignment::kLeft, 5,
       [](const JointRow& row) { return row.axis.is_closed ? "closed" : "open"; }},
      {"", 5, Alignment::kLeft, 2, [](const JointRow& row) { return state_text(row.axis); }}};
}

/// Total width of the columns, with one blank between neighbours.
int width_of(const std::vector<JointColumn>& columns) {
  int width = -1;
  for (const JointColumn& column : columns) width += column.width + 1;
  return width;
}

/// The columns that fit into `width`; the bar takes the remaining room.
std::vector<JointColumn> fitting_columns(int width) {
  std::vector<JointColumn> columns = all_columns();
  while (width_of(columns) > width) {
    const int rank = std::ranges::max_element(columns, {}, &JointColumn::rank)->rank;
    if (rank == 0) break;
    std::erase_if(columns, [rank](const JointColumn& column) { return column.rank == rank; });
  }
  for (JointColumn& column : columns) {
    if (column.kind != JointColumn::Alignment::kBar) continue;
    column.width =
        std::clamp(kMinBarLength + width - width_of(columns), kMinBarLength, kMaxBarLength);
  }
  return columns;
}

TextStyle style_of(const Axis& axis) {
  if (!axis.blocked.empty()) return TextStyle::kBad;
  return axis.is_moving ? TextStyle::kGood : TextStyle::kPlain;
}

/// Length of the filled part of the bar, in eighths of a column.
int filled_eighths(double value, const VariableRange& limits, int columns) {
  const double span = limits.max - limits.min;
  const double part = span > 0 ? (value - limits.min) / span : 0;
  return static_cast<int>(std::lround(std::clamp(part, 0.0, 1.0) * columns * kEighths));
}

void paint_bar(TextScreen& screen, int at, int from, int columns, const JointRow& row) {
  const int eighths = row.limits ? filled_eighths(row.axis.value, *row.limits, columns) : 0;
  for (int i = 0; i < columns; ++i) {
    const int here = std::clamp(eighths - i * kEighths, 0, kEighths);
    if (here == 0) {
      screen.put_letter(at, from + i, U'·', TextStyle::kFaint);
    } else {
      screen.put_letter(at, from + i, eighths_block(here), style_of(row.axis));
    }
  }
}

std::string aligned(const std::string& text, const JointColumn& column) {
  const std::size_t letters = one_column_letters(text).size();
  const auto width = static_cast<std::size_t>(column.width);
  if (column.kind != JointColumn::Alignment::kRight || letters >= width) return text;
  return std::string(width - letters, ' ') + text;
}

/// Paints the row of an axis; the heading if that is nullptr.
void paint_row(TextScreen& screen, int at, int from, const std::vector<JointColumn>& columns,
               const JointRow* row) {
  const TextStyle style = row == nullptr ? TextStyle::kFaint : style_of(row->axis);
  for (const JointColumn& column : columns) {
    if (row != nullptr && column.kind == JointColumn::Alignment::kBar) {
      paint_bar(screen, at, from, column.width, *row);
    } else {
      const std::string text = row == nullptr ? column.name : column.text(*row);
      screen.put(at, from, aligned(text, column), style, column.width);
    }
    from += column.width + 1;
  }
}

}  // namespace

void paint_joints(TextScreen& screen, const TextArea& area, const Known& known,
                  const WatchedState& state) {
  std::vector<JointRow> rows;
  const auto add = [&](const Axis& axis) {
    const auto found = known.limits.find(axis.label);
    rows.push_back({axis, found == known.limits.end()
                              ? std::nullopt
                              : std::optional<VariableRange>(found->second)});
  };
  for (const Axis& joint : state.joints) add(joint);
  add(state.tool.axis);

  const std::vector<JointColumn> columns = fitting_columns(area.columns);
  const int end = area.row + area.rows;
  int at = area.row;
  if (area.rows > static_cast<int>(rows.size())) {
    paint_row(screen, at++, area.column, columns, nullptr);
  }
  for (std::size_t i = 0; i < rows.size() && at < end; ++i, ++at) {
    paint_row(screen, at, area.column, columns, &rows[i]);
  }
}

}  // namespace xr3::watch
