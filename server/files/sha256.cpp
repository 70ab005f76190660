// Defines sha256() of cell/digest.hpp with nettle.
#include <nettle/sha2.h>

#include <array>

#include "cell/digest.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {

std::string sha256(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return "sha256:" + hexadecimal({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

}  // namespace xr3
