#include "core/drawing/palette.hpp"

namespace xr3 {
namespace {

struct Tones {
  std::string_view on_dark;
  std::string_view on_light;
};

constexpr std::array<Tones, kColors> kPalette{{
    {"#5a5f6a", "#000000"},  // black; a visible grey on dark
    {"#4a6fd0", "#1c3f94"},  // blue
    {"#3fa45b", "#1e7a3a"},  // green
    {"#2fa8a8", "#0b6e75"},  // cyan
    {"#c0504d", "#9c2a2a"},  // red
    {"#a85bb5", "#7a2e87"},  // magenta
    {"#b8863b", "#8a5a14"},  // brown
    {"#d0d0d0", "#5f6672"},  // light grey
    {"#8a8f99", "#9aa0aa"},  // dark grey
    {"#6f9bff", "#2460d8"},  // light blue
    {"#66d17a", "#2f9a3f"},  // light green
    {"#5fd7e0", "#1487a0"},  // light cyan
    {"#ff6b6b", "#d03030"},  // light red
    {"#e58cf0", "#b53cc4"},  // light magenta
    {"#f2d85c", "#b08a00"},  // yellow
    {"#ffffff", "#22262e"},  // white; nearly black on light
}};

constexpr std::uint8_t nibble(char digit) {
  return static_cast<std::uint8_t>(digit <= '9' ? digit - '0' : digit - 'a' + 10);
}

constexpr std::uint8_t channel(std::string_view hex, std::size_t at) {
  return static_cast<std::uint8_t>(nibble(hex[at]) * 16 + nibble(hex[at + 1]));
}

}  // namespace

std::string_view color_hex(int index, Background background) {
  const Tones& tones = kPalette[static_cast<std::size_t>(index)];
  return background == Background::kDark ? tones.on_dark : tones.on_light;
}

std::array<std::uint8_t, 3> color_rgb(int index, Background background) {
  const std::string_view hex = color_hex(index, background);
  return {channel(hex, 1), channel(hex, 3), channel(hex, 5)};
}

}  // namespace xr3
