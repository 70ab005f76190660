#include "server/options/address.hpp"

#include <cstdint>
#include <stdexcept>

#include "server/options/whole_number.hpp"

namespace xr3 {

// With a port, an IPv6 address must be in brackets, since it contains colons itself.
PortAddress parse_address(const std::string& text, const std::string& usual_port) {
  PortAddress address{text, text, usual_port};
  const std::size_t colon = text.rfind(':');
  const bool is_bare_ipv6 = text.find(':') != colon && !text.starts_with('[');
  const bool has_port = colon != std::string::npos && !is_bare_ipv6 && !text.ends_with(']');
  if (has_port) {
    address.host = text.substr(0, colon);
    address.port = text.substr(colon + 1);
  }
  std::string& host = address.host;
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.empty() || !whole_number<std::uint16_t>(address.port, 1, 65535)) {
    throw std::invalid_argument(text + ": an address is HOST:PORT, as in localhost:" + usual_port);
  }
  return address;
}

}  // namespace xr3
