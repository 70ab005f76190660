// A picture as SVG text: one path for each stretch of lines of one part.
#pragma once

#include <string>

#include "protocol/picture.hpp"

namespace xr3 {

/// A whole document. Each path names its part in `data-part`.
std::string to_svg(const Picture& picture);

}  // namespace xr3
