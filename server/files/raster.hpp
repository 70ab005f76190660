// Rasterizes a picture: anti-aliased lines with round ends, by the distance of each pixel's centre
// from the line. docs/decisions/0007-pictures.md has the reasons for not using a library.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/drawing/picture.hpp"

namespace xr3 {

using Rgb = std::array<std::uint8_t, 3>;

struct Raster {
  int width_px = 0;
  int height_px = 0;
  std::vector<Rgb> pixels;  ///< row by row from the top
};

/// Rasterizes the lines, clipped at the edges.
Raster rasterized(const Picture& picture);

}  // namespace xr3
