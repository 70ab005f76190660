// Pixels as a PNG file, by libpng.
#pragma once

#include <string>

#include "core/image.hpp"
#include "server/raster.hpp"

namespace xr3 {

/// The bytes of a file with red, green and blue of 8 bits each.
std::string to_png(const Raster& raster);

/// The bytes of a file with one bit a pixel, 1 as white.
std::string to_png(const Image& image);

}  // namespace xr3
