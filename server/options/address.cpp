#include "server/options/address.hpp"

#include <charconv>
#include <cstdint>
#include <stdexcept>

namespace xr3 {
namespace {

bool is_port(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc{} && end == text.data() + text.size() && port != 0;
}

}  // namespace

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
  if (host.empty() || !is_port(address.port)) {
    throw std::invalid_argument(text + ": an address is HOST:PORT, as in localhost:" + usual_port);
  }
  return address;
}

}  // namespace xr3
