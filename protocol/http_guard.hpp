// Which web pages may talk to the monitor port, by the Host and Origin that their browser sends: a
// name that a foreign name server can point at this machine is refused, and so is a page from
// elsewhere. Text in, verdict out; it knows no requests.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::http {

/// Who can reach the address that the server is bound to.
enum class Reach : std::uint8_t { kThisMachine, kBeyond };

/// What is allowed besides the server's own addresses.
struct GuardRules {
  Reach reach = Reach::kThisMachine;
  std::vector<std::string> hosts;    ///< names, compared without regard to case
  std::vector<std::string> origins;  ///< each exactly as a browser sends it
};

/// Whether a Host, whatever its port, is an IP literal, localhost, a name under it or one of the
/// rules' hosts; beyond this machine also a name without a dot, as compose and a lab's network have.
bool is_host_allowed(std::string_view host, const GuardRules& rules);

/// Whether an Origin is exactly `http://` and the request's Host, or one of the rules'; `null` never.
bool is_origin_allowed(std::string_view origin, std::string_view host, const GuardRules& rules);

/// An IP literal, localhost or a name under it, whatever the port: what no foreign name server can
/// point at this machine.
bool is_local_host(std::string_view host);

/// Letters, digits, `-`, `_` and single dots between them: what may be a rule's host.
bool is_host_name(std::string_view name);

/// `http://` or `https://`, a host and perhaps a port, nothing behind: what may be a rule's origin.
bool is_origin(std::string_view text);

/// Equal but for upper and lower case of ASCII.
bool is_same_name(std::string_view a, std::string_view b);

}  // namespace xr3::http
