#include "tools/watch/top_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <vector>

#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

constexpr int kMaxColumns = 70;
constexpr int kMaxRows = 32;
constexpr int kLegendColumns = 78;
constexpr double kTouchMm = 1e-6;  ///< tolerance: a centre on the edge of a block is inside
constexpr std::string_view kLetters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQSTUVWXYZ1234567890";
constexpr char kNoLetter = '#';

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// The smallest of a few round numbers that is at least `number`.
double round_up(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  for (const double digits : {1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (digits * power >= number) return digits * power;
  }
  return 10 * power;
}

/// The picture. A character is `mm_` wide and twice as high, as on most terminals.
class Grid {
 public:
  explicit Grid(const Workspace& space)
      : mm_(round_up(std::max(mm(space.x_um) / kMaxColumns, mm(space.y_um) / kMaxRows))),
        half_(static_cast<int>(std::ceil(mm(space.y_um) / mm_ / 2))),
        columns_(static_cast<int>(std::ceil(mm(space.x_um) / mm_))),
        lines_(static_cast<std::size_t>(rows()),
               std::string(static_cast<std::size_t>(columns_), ' ')) {}

  int rows() const { return 2 * half_; }
  int columns() const { return columns_; }
  double mm_per_column() const { return mm_; }
  double x_at(int column) const { return (column + 0.5) * mm_; }
  double y_at(int row) const { return (half_ - row - 0.5) * 2 * mm_; }
  int column_of(double x_mm) const { return static_cast<int>(std::floor(x_mm / mm_)); }
  int row_of(double y_mm) const { return half_ - 1 - static_cast<int>(std::floor(y_mm / mm_ / 2)); }

  bool has(int row, int column) const {
    return row >= 0 && row < rows() && column >= 0 && column < columns_;
  }
  void put(int row, int column, char sign) {
    if (!has(row, column)) return;
    lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = sign;
  }

  std::string framed(const Workspace& space) const;

 private:
  double mm_;
  int half_;  ///< rows on either side of the base
  int columns_;
  std::vector<std::string> lines_;
};

std::string Grid::framed(const Workspace& space) const {
  const auto width = static_cast<std::size_t>(columns_);
  const std::string edge = "+" + std::string(width, '-') + "+\n";
  std::string text = " y = " + plain_number(mm(space.y_um)) + " mm\n" + edge;
  for (int row = 0; row < rows(); ++row) {
    text += (row == row_of(0) ? "R" : "|") + lines_[static_cast<std::size_t>(row)] + "|\n";
  }
  const std::string left = " y = -" + plain_number(mm(space.y_um));
  const std::string right = "x = " + plain_number(mm(space.x_um));
  const std::size_t used = left.size() + right.size();
  return text + edge + left + std::string(width > used ? width + 1 - used : 1, ' ') + right + "\n";
}

void draw_reach(Grid& picture, const ReachAbove& reaches) {
  for (int row = 0; row < picture.rows(); ++row) {
    for (int column = 0; column < picture.columns(); ++column) {
      if (reaches(picture.x_at(column), picture.y_at(row))) picture.put(row, column, '.');
    }
  }
}

void draw_camera(Grid& picture, const Camera& camera) {
  const double x = mm(camera.location_um.x);
  const double y = mm(camera.location_um.y);
  const int top = std::max(picture.row_of(y + mm(camera.field_y_um) / 2), -1);
  const int bottom = std::min(picture.row_of(y - mm(camera.field_y_um) / 2), picture.rows());
  const int left = std::max(picture.column_of(x - mm(camera.field_x_um) / 2), -1);
  const int right = std::min(picture.column_of(x + mm(camera.field_x_um) / 2), picture.columns());
  for (int row = top; row <= bottom; ++row) {
    picture.put(row, left, ':');
    picture.put(row, right, ':');
  }
  for (int column = left; column <= right; ++column) {
    picture.put(top, column, ':');
    picture.put(bottom, column, ':');
  }
}

/// Draws every character whose centre lies in the block, and the one at the block's centre.
void draw_block(Grid& picture, const Block& block, char letter) {
  const double x = mm(block.centroid_um.x);
  const double y = mm(block.centroid_um.y);
  const double yaw = degrees(block.yaw_udeg) * kPi / 180;
  const double along = mm(block.size_um.x) / 2;
  const double across = mm(block.size_um.y) / 2;
  const double around = std::hypot(along, across);
  const int first_row = std::max(picture.row_of(y + around), 0);
  const int last_row = std::min(picture.row_of(y - around), picture.rows() - 1);
  const int first_column = std::max(picture.column_of(x - around), 0);
  const int last_column = std::min(picture.column_of(x + around), picture.columns() - 1);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double dx = picture.x_at(column) - x;
      const double dy = picture.y_at(row) - y;
      const bool is_in = std::abs(dx * std::cos(yaw) + dy * std::sin(yaw)) <= along + kTouchMm &&
                         std::abs(dy * std::cos(yaw) - dx * std::sin(yaw)) <= across + kTouchMm;
      if (is_in) picture.put(row, column, letter);
    }
  }
  picture.put(picture.row_of(y), picture.column_of(x), letter);
}

/// Draws the blocks in the order of their tops, so that the upper of stacked blocks is visible.
void draw_blocks(Grid& picture, const std::vector<Block>& blocks) {
  std::vector<std::size_t> order(blocks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto top = [&](std::size_t i) { return blocks[i].centroid_um.z * 2 + blocks[i].size_um.z; };
  std::ranges::stable_sort(order, {}, top);
  const std::string letters = block_letters(blocks);
  for (const std::size_t i : order) draw_block(picture, blocks[i], letters[i]);
}

/// `r red, g green`, over several lines. Blocks without a letter are only counted.
std::string block_legend(const std::vector<Block>& blocks) {
  const std::string letters = block_letters(blocks);
  std::string text;
  std::string line;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (letters[i] == kNoLetter) continue;
    const std::string entry = std::string(1, letters[i]) + " " + printable_line(blocks[i].name);
    if (!line.empty() && line.size() + entry.size() + 2 > kLegendColumns) {
      text += " " + line + ",\n";
      line.clear();
    }
    line += (line.empty() ? "" : ", ") + entry;
  }
  if (blocks.size() > kLetters.size())
    line += ", # " + std::to_string(blocks.size() - kLetters.size()) + " more";
  return line.empty() ? text : text + " " + line + "\n";
}

}  // namespace

std::string top_view(const Workcell& workcell, const ReachAbove& reaches) {
  Grid picture(workcell.workspace);
  if (reaches) draw_reach(picture, reaches);
  if (workcell.camera) draw_camera(picture, *workcell.camera);
  draw_blocks(picture, workcell.blocks);
  const double column = picture.mm_per_column();
  std::string legend = " R robot";
  if (reaches) legend += "   . within reach";
  if (workcell.camera) legend += "   : camera's field";
  legend += "   a character is " + plain_number(column) + " x " + plain_number(2 * column) + " mm";
  return picture.framed(workcell.workspace) + legend + "\n" + block_legend(workcell.blocks);
}

std::string block_letters(const std::vector<Block>& blocks) {
  std::string letters(blocks.size(), kNoLetter);
  std::string free(kLetters);
  const auto take = [&](std::size_t i, std::string_view wanted) {
    const std::size_t at = wanted.find_first_of(free);
    if (letters[i] != kNoLetter || at == std::string_view::npos) return;
    letters[i] = wanted[at];
    std::erase(free, wanted[at]);
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) take(i, lower_case(blocks[i].name.substr(0, 1)));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::string name = lower_case(blocks[i].name);
    take(i, std::string(name.rbegin(), name.rend()) + free);
  }
  return letters;
}

}  // namespace xr3
