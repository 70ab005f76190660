#include "server/files/sha256.hpp"

#include <nettle/sha2.h>

#include "cell/digest.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {

Sha256 sha256_bytes(std::string_view text) {
  static_assert(std::tuple_size_v<Sha256> == SHA256_DIGEST_SIZE);
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  Sha256 digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

// Declared in cell/digest.hpp.
std::string sha256(std::string_view text) {
  const Sha256 digest = sha256_bytes(text);
  return "sha256:" + hexadecimal({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

}  // namespace xr3
