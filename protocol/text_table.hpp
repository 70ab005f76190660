// Plain text for people: numbers without needless digits, and columns that line up.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// A number with at most so many decimals, without trailing zeros and never -0.
std::string plain_number(double number, int decimals = 3);
/// A number with just so many decimals, for columns; never -0.
std::string fixed_number(double number, int decimals);

/// Rows of cells, the first one the heading. Each column is as wide as its widest cell; one whose
/// letter in `alignment` is 'r' is flush right, any other flush left. Every line is indented by two
/// blanks, carries none at its end, and ends with a line feed.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::string& alignment);

}  // namespace xr3
