#include "server/session/access.hpp"

#include <nettle/memops.h>

#include "cell/sha256.hpp"

namespace xr3 {
namespace {

// Compares digests, which have equal lengths, so that the time does not reveal the token's length.
bool are_equal(std::string_view one, std::string_view other) {
  const Sha256 first = sha256_bytes(one);
  const Sha256 second = sha256_bytes(other);
  return memeql_sec(first.data(), second.data(), first.size()) != 0;
}

}  // namespace

bool AccessPolicy::is_right(std::string_view token) const {
  return needs_token() && are_equal(token, rules_.token);
}

bool AccessPolicy::is_right_for_metrics(std::string_view token) const {
  return has_metrics_token() && are_equal(token, rules_.metrics_token);
}

}  // namespace xr3
