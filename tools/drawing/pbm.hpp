// A binary image as a portable bitmap (PBM, plain format), which a shell script can read.
#pragma once

#include <string>

#include "core/image.hpp"

namespace xr3 {

/// The image as text: `P1`, width and height, then one line of 0 and 1 per row, from the top.
std::string to_pbm(const Image& image);

}  // namespace xr3
