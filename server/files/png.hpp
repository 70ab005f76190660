// PNG encoding (libpng).
#pragma once

#include <string>

#include "core/image.hpp"
#include "server/files/raster.hpp"

namespace xr3 {

/// The bytes of an RGB file, 8 bits per channel.
std::string to_png(const Raster& raster);

/// The bytes of a file with one bit per pixel; 1 is white.
std::string to_png(const Image& image);

}  // namespace xr3
