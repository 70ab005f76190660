// Formats numbers without superfluous digits, and tables with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// A number with at most `decimals` decimals, without trailing zeros; never -0.
std::string plain_number(double number, int decimals = 3);
/// A number with exactly `decimals` decimals, for columns; never -0.
std::string fixed_number(double number, int decimals);

/// A number with at most `digits` significant digits, as by printf's %g.
std::string significant_digits(double number, int digits);

/// Formats rows of cells; the first row is the heading. Cells are printed by printable_line(). A
/// column is as wide as its widest cell, and right-aligned if its letter in `alignment` is 'r',
/// otherwise left-aligned. Every line is indented by two blanks, has no trailing blanks, and ends
/// with a line feed.
std::string text_table(const std::vector<std::vector<std::string>>& cells,
                       const std::string& alignment);

}  // namespace xr3
