// The sixteen colours of a robot or workcell file (paper, Section III-A, Link Data): the order of the
// EGA palette, in tones that are easier on the eye.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace xr3 {

/// What a picture is drawn on. Pale colours cannot be read on white, nor dark ones on black.
enum class Background : std::uint8_t { kDark, kLight };

inline constexpr int kColors = 16;

/// The colour of an index 0...15 as #rrggbb.
std::string_view color_hex(int index, Background background);

/// Its red, green and blue, 0...255 each.
std::array<std::uint8_t, 3> color_rgb(int index, Background background);

}  // namespace xr3
