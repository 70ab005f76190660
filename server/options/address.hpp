// The address of a port, as an argument of the commands that connect to a server.
#pragma once

#include <string>

namespace xr3 {

struct PortAddress {
  std::string text;  ///< HOST, HOST:PORT or [IPv6]:PORT, as given
  std::string host;
  std::string port;
};

/// Parses HOST, HOST:PORT or [IPv6]:PORT. Throws std::invalid_argument, with the allowed form.
PortAddress parse_address(const std::string& text, const std::string& usual_port);

}  // namespace xr3
