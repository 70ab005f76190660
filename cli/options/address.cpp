#include "cli/options/address.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "protocol/text/whole_number.hpp"

namespace xr3 {
namespace {

bool is_port_number(const std::string& text) {
  return whole_number<std::uint16_t>(text, 1, 65535).has_value();
}

/// Whether the text is a host. Resolvers take a number for an IPv4 address: 9601 for 0.0.37.129.
bool is_host(const std::string& text) {
  const bool is_number = text.find_first_not_of("0123456789") == std::string::npos;
  // An empty text counts as a number, too.
  return !is_number && text.find('/') == std::string::npos;
}

/// The host and port of the page's address: without scheme, final slash and fragment.
std::string without_scheme(const std::string& text) {
  constexpr std::string_view kScheme = "http://";
  if (!text.starts_with(kScheme)) return text;
  std::string place = text.substr(kScheme.size());
  place.erase(std::min(place.find('#'), place.size()));
  if (place.ends_with('/')) place.pop_back();
  return place;
}

}  // namespace

// With a port, an IPv6 address must be in brackets, since it contains colons itself.
PortAddress parse_address(const std::string& text, const std::string& usual_port) {
  const std::string place = without_scheme(text);
  if (is_port_number(place)) return {"localhost:" + place, "localhost", place, true};
  PortAddress address{place, place, usual_port};
  const std::size_t colon = place.rfind(':');
  const bool is_bare_ipv6 = place.find(':') != colon && !place.starts_with('[');
  address.has_port = colon != std::string::npos && !is_bare_ipv6 && !place.ends_with(']');
  if (address.has_port) {
    address.host = place.substr(0, colon);
    address.port = place.substr(colon + 1);
  }
  std::string& host = address.host;
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (!is_host(host) || !is_port_number(address.port)) {
    throw std::invalid_argument(text + ": an address is HOST:PORT, as in localhost:" + usual_port +
                                ", or the PORT of this machine");
  }
  return address;
}

PortAddress with_port(const PortAddress& address, const std::string& port) {
  if (address.has_port) throw std::invalid_argument(address.text + " has a port already: " + port);
  if (!is_port_number(port))
    throw std::invalid_argument(port + ": a port is a number from 1 to 65535");
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  const std::string host = is_ipv6 ? "[" + address.host + "]" : address.host;
  return {host + ":" + port, address.host, port, true};
}

}  // namespace xr3
