// A pose as it is given on a command line: joint variables in degrees and mm, brought to whole counts.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/model.hpp"

namespace xr3 {

/// An argument that cannot be obeyed; the message says which, and what is allowed.
class ArgumentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Numbers between commas, as in "0,-39.01,109.89". Throws std::invalid_argument.
std::vector<double> parse_numbers(const std::string& text);

/// Positions nearest to joint variables from the base on (degrees or mm; none: the soft home) and to a
/// tool variable. Throws ArgumentError for a wrong number of them, or one beyond its limits.
Positions pose_argument(const Model& model, const std::vector<double>& joints,
                        std::optional<double> tool);

}  // namespace xr3
