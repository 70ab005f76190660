// The sixteen colours of robot and workcell files (paper, Section III-A, Link Data): in the order
// of the EGA palette, with softer tones.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace xr3 {

/// The background of a picture. It selects the tones: pale colours cannot be read on white, dark
/// ones not on black.
enum class Background : std::uint8_t { kDark, kLight };

inline constexpr int kColors = 16;

/// The colour with index 0...15 as #rrggbb.
std::string_view color_hex(int index, Background background);

/// The colour with index 0...15 as red, green and blue, 0...255 each.
std::array<std::uint8_t, 3> color_rgb(int index, Background background);

}  // namespace xr3
