#include "protocol/scene/colors.hpp"

#include "core/drawing/palette.hpp"

namespace xr3 {
namespace {

constexpr std::array<std::uint32_t, kColors> kSolidColors{
    0x2b3036,  // black
    0x3b6fd4,  // blue
    0x3f9e5a,  // green
    0x7d93a6,  // cyan
    0xb3524a,  // red
    0x8a62b8,  // magenta
    0xc98a3c,  // brown
    0xc9ced4,  // light grey
    0x6b747e,  // dark grey
    0x4f8ff7,  // light blue
    0x4fbf6b,  // light green
    0x8fa9bd,  // light cyan
    0xe0584f,  // light red
    0xc26fd6,  // light magenta
    0xefc443,  // yellow
    0xf4f6f8,  // white
};

}  // namespace

std::array<std::uint8_t, 3> solid_rgb(int color) {
  const std::uint32_t rgb = kSolidColors[static_cast<std::size_t>(color)];
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

}  // namespace xr3
