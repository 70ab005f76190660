#include "protocol/text/numbers.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace xr3 {

std::vector<double> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream items(text + ",");
  for (std::string item; std::getline(items, item, ',');) {
    std::istringstream in(item);
    double number = 0;
    if (!(in >> number) || !(in >> std::ws).eof() || !std::isfinite(number)) {
      throw std::invalid_argument(text +
                                  ": expected numbers separated by commas, as in 0,-39.5,110");
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace xr3
