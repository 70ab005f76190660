// A picture as pixels: round-ended lines with soft edges on white, by the distance of each pixel's
// centre from the line. Why our own: docs/decisions/0007-pictures.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/picture.hpp"

namespace xr3 {

using Rgb = std::array<std::uint8_t, 3>;

struct Raster {
  int width_px = 0;
  int height_px = 0;
  std::vector<Rgb> pixels;  ///< row by row from the top
};

/// Lines beyond the sheet are cut off.
Raster rasterized(const Picture& picture);

}  // namespace xr3
