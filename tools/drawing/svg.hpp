// A picture as SVG text: one path for each run of wires of one part.
#pragma once

#include <string>

#include "tools/drawing/picture.hpp"

namespace xr3 {

/// A complete document. Each path has its part's name in `data-part`.
std::string to_svg(const Picture& picture);

}  // namespace xr3
