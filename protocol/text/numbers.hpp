// Lists of numbers in arguments and addresses.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// Parses numbers separated by commas, such as "0,-39.01,109.89". Throws std::invalid_argument.
std::vector<double> parse_numbers(const std::string& text);

}  // namespace xr3
