#include "protocol/text/table.hpp"

#include <algorithm>
#include <iomanip>

#include "protocol/text/printable.hpp"
#include "protocol/text/text_stream.hpp"

namespace xr3 {
namespace {

/// The number of letters: UTF-8 continuation bytes do not count.
std::size_t width_of(const std::string& cell) {
  return static_cast<std::size_t>(
      std::count_if(cell.begin(), cell.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

using TableRows = std::vector<std::vector<std::string>>;

TableRows printable_cells(TableRows rows) {
  for (auto& row : rows)
    for (std::string& cell : row) cell = printable_line(cell);
  return rows;
}

std::vector<std::size_t> column_widths(const TableRows& rows, std::size_t columns) {
  std::vector<std::size_t> widths(columns, 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  return widths;
}

void drop_trailing(std::string& text, char unwanted) {
  text.erase(text.find_last_not_of(unwanted) + 1);
}

}  // namespace

std::string fixed_number(double number, int decimals) {
  TextStream out;
  out << std::fixed << std::setprecision(decimals) << number;
  const std::string text = out.str();
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string plain_number(double number, int decimals) {
  std::string text = fixed_number(number, decimals);
  if (text.find('.') != std::string::npos) {
    drop_trailing(text, '0');
    drop_trailing(text, '.');
  }
  return text;
}

std::string significant_digits(double number, int digits) {
  TextStream out;
  out << std::setprecision(digits) << number;
  return out.str();
}

std::string text_table(const std::vector<std::vector<std::string>>& cells,
                       const std::string& alignment) {
  const TableRows rows = printable_cells(cells);
  const std::vector<std::size_t> widths = column_widths(rows, alignment.size());
  std::string table;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      line += "  " + (alignment[i] == 'r' ? padding + row[i] : row[i] + padding);
    }
    drop_trailing(line, ' ');
    table += line + "\n";
  }
  return table;
}

}  // namespace xr3
