// A binary image as a portable bitmap (PBM, plain form): text that a shell script can read.
#pragma once

#include <string>

#include "core/image.hpp"

namespace xr3 {

/// `P1`, width and height, then each row from the top as a line of 0 and 1.
std::string to_pbm(const Image& image);

}  // namespace xr3
