// Formats JSON for data files: a value that fits on a line is on one line, and lists of points fill
// their lines. Independent of the meaning of members.
#pragma once

#include <string>

#include "protocol/json/source.hpp"

namespace xr3 {

/// The formatted value, with a line feed at the end. Lines have at most 100 columns unless they
/// contain long texts. Numbers are exact: they read back as the same double.
std::string json_text(const Json& value);

}  // namespace xr3
