#include "server/session/access.hpp"

#include <nettle/memops.h>
#include <nettle/sha2.h>

namespace xr3 {
namespace {

// Compares digests, which have equal lengths, so that the time does not reveal the token's length.
bool are_equal(std::string_view one, std::string_view other) {
  const TokenDigest first = digest_of_token(one);
  const TokenDigest second = digest_of_token(other);
  return memeql_sec(first.data(), second.data(), first.size()) != 0;
}

}  // namespace

TokenDigest digest_of_token(std::string_view token) {
  static_assert(std::tuple_size_v<TokenDigest> == SHA256_DIGEST_SIZE);
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, token.size(), reinterpret_cast<const std::uint8_t*>(token.data()));
  TokenDigest result;
  sha256_digest(&context, result.size(), result.data());
  return result;
}

bool AccessPolicy::is_right(std::string_view token) const {
  return needs_token() && are_equal(token, rules_.token);
}

bool AccessPolicy::is_right_for_metrics(std::string_view token) const {
  return has_metrics_token() && are_equal(token, rules_.metrics_token);
}

}  // namespace xr3
