#include "tools/drawing/view_vector.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "protocol/text/numbers.hpp"

namespace xr3 {

ViewVector parse_view(const std::string& text) {
  const auto is_allowed = [](double n) { return n >= -9 && n <= 9 && n == static_cast<int>(n); };
  const std::vector<double> v = parse_numbers(text);
  const bool is_good = v.size() == 3 && std::all_of(v.begin(), v.end(), is_allowed);
  if (!is_good || v == std::vector<double>{0, 0, 0}) {
    throw std::invalid_argument(
        text + ": a view is three whole numbers from -9 to 9, not all 0, as in 1,1,1");
  }
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
}

}  // namespace xr3
