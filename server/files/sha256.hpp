// SHA-256, with nettle.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace xr3 {

using Sha256 = std::array<std::uint8_t, 32>;

Sha256 sha256_bytes(std::string_view text);

}  // namespace xr3
