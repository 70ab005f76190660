// Decides by the Host and Origin headers which web pages may access the monitor port. It refuses
// host names that a foreign name server can resolve to this machine (DNS rebinding) and pages from
// other origins. Works on header values only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::http {

/// The hosts that can reach the server's address.
enum class HostReach : std::uint8_t { kThisMachine, kBeyond };

/// The word for desktop apps among a rule's origins.
inline constexpr std::string_view kDesktopOrigin = "desktop";

/// Hosts and origins allowed in addition to the server's own addresses.
struct GuardRules {
  HostReach reach = HostReach::kThisMachine;
  std::vector<std::string> hosts;    ///< names, compared case-insensitively
  std::vector<std::string> origins;  ///< exactly as a browser sends them, or kDesktopOrigin
};

/// Whether a Host, ignoring its port, is an IP literal, localhost, a subdomain of it, or one of the
/// rules' hosts. With Reach::kBeyond also a name without a dot, as used by compose and in local
/// networks.
bool is_host_allowed(std::string_view host, const GuardRules& rules);

/// Whether an Origin is exactly `http://` plus the request's Host, or one of the rules' origins.
/// Never true for `null`.
bool is_origin_allowed(std::string_view origin, std::string_view host, const GuardRules& rules);

/// Whether the rules' origins contain kDesktopOrigin, and an Origin is `null` or begins with
/// `file://`, as those of desktop apps do. A page of any site can have the origin `null`: for paths
/// that change nothing.
bool is_desktop_allowed(std::string_view origin, const GuardRules& rules);

/// Whether a Host, ignoring its port, is an IP literal, localhost or a subdomain of it. No foreign
/// name server can resolve these to this machine.
bool is_local_host(std::string_view host);

/// Whether a name may be a rule's host: letters, digits, `-`, `_` and single dots between them.
bool is_host_name(std::string_view name);

/// Whether a text may be a rule's origin: `http://` or `https://`, a host, optionally a port, no
/// path.
bool is_origin(std::string_view text);

/// Case-insensitive comparison (ASCII).
bool is_same_name(std::string_view a, std::string_view b);

}  // namespace xr3::http
