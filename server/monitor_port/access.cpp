#include "server/monitor_port/access.hpp"

#include <nettle/memops.h>
#include <nettle/sha2.h>

namespace xr3 {
TokenDigest digest_of_token(std::string_view token) {
  static_assert(std::tuple_size_v<TokenDigest> == SHA256_DIGEST_SIZE);
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, token.size(), reinterpret_cast<const std::uint8_t*>(token.data()));
  TokenDigest result;
  sha256_digest(&context, result.size(), result.data());
  return result;
}

// Compares digests, which have equal lengths, so that the time does not reveal the token's length.
bool AccessPolicy::is_right(std::string_view token) const {
  const TokenDigest given = digest_of_token(token);
  const TokenDigest wanted = digest_of_token(rules_.token);
  return needs_token() && memeql_sec(given.data(), wanted.data(), wanted.size()) != 0;
}

}  // namespace xr3
