// The view vector as text.
#pragma once

#include <string>

#include "core/state.hpp"

namespace xr3 {

/// Parses `x,y,z`, integers -9...9, not all 0. Throws std::invalid_argument, with the allowed
/// values.
ViewVector parse_view(const std::string& text);

}  // namespace xr3
