// The robot's data file (paper, Section III-A and Table II) as text to value and back. The text comes
// from the caller: nothing here reads a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "protocol/finding.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// A robot, unless a finding is an error, and everything found in its file, sorted by line.
struct RobotReading {
  std::optional<Robot> robot;
  Findings findings;
};

/// Reads and checks a robot file. Syntax errors are findings like all others: it never throws.
RobotReading read_robot(std::string_view text, const std::string& file);

/// The robot in a file's text. Throws DataError with every finding if one of them is an error.
Robot load_robot(std::string_view text, const std::string& file);

/// The file form in mm, its members in the documented order. Loaded again it gives an equal robot.
Json robot_to_json(const Robot& robot);

}  // namespace xr3
