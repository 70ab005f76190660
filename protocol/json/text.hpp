// JSON as a data file shows it: what fits on a line stands on one, lists of points fill their lines.
// It knows nothing of what the members mean.
#pragma once

#include <string>

#include "protocol/json/source.hpp"

namespace xr3 {

/// The value over as many lines as it needs, none longer than 100 columns but for long texts; ended by
/// a line feed. Numbers read back to the same double.
std::string json_text(const Json& value);

}  // namespace xr3
