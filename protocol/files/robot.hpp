// Converts robot files (paper, Section III-A and Table II) from text to values and back. The text
// comes from the caller; no file is read here.
#pragma once

#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "protocol/json/finding.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// The parts of a tool that a robot file may list.
inline constexpr std::size_t kMaxToolParts = 16;

/// Reads and checks a robot file. Syntax errors are findings, too. Never throws.
FileReading<Robot> read_robot(std::string_view text, const std::string& file);

/// Reads and checks a robot file. Throws DataError with all findings if one of them is an error.
Robot load_robot(std::string_view text, const std::string& file);

/// The JSON of a robot file, in mm, with its members in the documented order. Loading it gives an
/// equal robot.
Json robot_to_json(const Robot& robot);

}  // namespace xr3
