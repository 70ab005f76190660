// Who may do what on the monitor port: which pages are let in, whether calls and reading need the
// token, and whether a token is the right one. Only the bind address counts, never a peer's: behind
// a container's port forwarder every peer may be this machine. It knows no connection.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/http_guard.hpp"

namespace xr3 {

/// Whether looking at the cell needs the token, too.
enum class Reading : std::uint8_t { kFree, kWithToken };

struct AccessRules {
  http::GuardRules guard;
  Reading reading = Reading::kFree;
  std::string token;  ///< empty: there is none, and everybody let in may call
};

class AccessPolicy {
 public:
  /// This machine's own clients, without a token.
  AccessPolicy() = default;
  explicit AccessPolicy(AccessRules rules) : rules_(std::move(rules)) {}

  /// Calls need the token.
  bool needs_token() const { return !rules_.token.empty(); }
  /// Reading needs it as well. Never true where there is no token.
  bool is_private() const { return needs_token() && rules_.reading == Reading::kWithToken; }
  /// Whether this is the token, in a time that does not tell how much of it is right. False where
  /// there is none.
  bool is_right(std::string_view token) const;

  bool is_host_allowed(std::string_view host) const {
    return http::is_host_allowed(host, rules_.guard);
  }
  bool is_origin_allowed(std::string_view origin, std::string_view host) const {
    return http::is_origin_allowed(origin, host, rules_.guard);
  }

 private:
  AccessRules rules_;
};

}  // namespace xr3
