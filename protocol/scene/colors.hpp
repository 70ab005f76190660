// The sixteen colours of robot and workcell files on solids. (core/drawing/palette.hpp has those of
// lines.)
#pragma once

#include <array>
#include <cstdint>

namespace xr3 {

/// The colour with index 0...15 as red, green and blue, as the page has it
/// (clients/web/src/lib/palette.js).
std::array<std::uint8_t, 3> solid_rgb(int color);

}  // namespace xr3
