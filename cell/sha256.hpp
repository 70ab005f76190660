// SHA-256, FIPS 180-4. Our own, since it must be the same in WebAssembly, for which Debian has no
// library.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace xr3 {

using Sha256 = std::array<std::uint8_t, 32>;

/// The digest of the text. A byte takes less than 10 ns.
Sha256 sha256_bytes(std::string_view text);

}  // namespace xr3
