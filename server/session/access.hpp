// Access control of the monitor port: which web pages are allowed, whether calls and reading
// require the token, and the check of a token. It depends on the bind address, never on the peer's
// address: behind a container's port forwarder every peer can appear to be this machine.
// Independent of connections.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor/http_guard.hpp"

namespace xr3 {

/// Whether reading the cell requires the token, too.
enum class ReadAccess : std::uint8_t { kFree, kWithToken };

struct AccessRules {
  http::GuardRules guard;
  ReadAccess reading = ReadAccess::kFree;
  std::string token;  ///< empty if calls require no token
  /// Token for /metrics alone, if reading requires a token; empty if there is none.
  std::string metrics_token = {};
  /// Origins of the pages that may show the robot's page in a frame.
  std::vector<std::string> frame_origins = {};
};

class AccessPolicy {
 public:
  /// Clients on this machine only, without a token.
  AccessPolicy() = default;
  explicit AccessPolicy(AccessRules rules) : rules_(std::move(rules)) {}

  /// Whether calls require the token.
  bool needs_token() const { return !rules_.token.empty(); }
  /// Whether reading requires it, too. Always false without a token.
  bool is_private() const { return needs_token() && rules_.reading == ReadAccess::kWithToken; }
  /// Compares in constant time. Always false if no token is set.
  bool is_right(std::string_view token) const;

  bool has_metrics_token() const { return !rules_.metrics_token.empty(); }
  /// Compares in constant time. Always false if there is none.
  bool is_right_for_metrics(std::string_view token) const;

  bool is_host_allowed(std::string_view host) const {
    return http::is_host_allowed(host, rules_.guard);
  }
  bool is_origin_allowed(std::string_view origin, std::string_view host) const {
    return http::is_origin_allowed(origin, host, rules_.guard);
  }
  /// Whether desktop apps are allowed, and this is an origin of theirs.
  bool is_desktop_allowed(std::string_view origin) const {
    return http::is_desktop_allowed(origin, rules_.guard);
  }
  const std::vector<std::string>& frame_origins() const { return rules_.frame_origins; }

 private:
  AccessRules rules_;
};

}  // namespace xr3
