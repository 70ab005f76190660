// SHA-256 digests. Portable: the same on every machine.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"

namespace xr3 {

/// The SHA-256 of the text: `sha256:` and 64 hexadecimal digits.
std::string sha256(std::string_view text);

/// The digest of robot and profile. A snapshot can be loaded only if it has the same.
std::string robot_hash(const Model& model);

}  // namespace xr3
