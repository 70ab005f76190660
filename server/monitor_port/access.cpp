#include "server/monitor_port/access.hpp"

#include <nettle/memops.h>
#include <nettle/sha2.h>

#include <array>

namespace xr3 {
namespace {

using Digest = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

Digest digest(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  Digest result;
  sha256_digest(&context, result.size(), result.data());
  return result;
}

}  // namespace

// Compares digests, which have equal lengths, so that the time does not reveal the token's length.
bool AccessPolicy::is_right(std::string_view token) const {
  const Digest given = digest(token);
  const Digest wanted = digest(rules_.token);
  return needs_token() && memeql_sec(given.data(), wanted.data(), wanted.size()) != 0;
}

}  // namespace xr3
