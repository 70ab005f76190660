// Fingerprints of what can be compared: equal texts have equal ones, on every machine. By nettle.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "core/robot.hpp"

namespace xr3 {

/// `sha256:` and 64 hexadecimal digits.
std::string sha256(std::string_view text);

/// Of what must be the same for a snapshot to fit: the robot, and the profile.
std::string robot_hash(const Model& model);

}  // namespace xr3
