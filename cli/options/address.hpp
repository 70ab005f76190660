// The address of a port, as an argument of the commands that connect to a server.
#pragma once

#include <string>

namespace xr3 {

struct PortAddress {
  std::string text;  ///< HOST, HOST:PORT or [IPv6]:PORT, for messages
  std::string host;
  std::string port;
  bool has_port = false;  ///< the port is part of the text
};

/// Parses HOST, HOST:PORT, [IPv6]:PORT, PORT of this machine, or the http address of a page without
/// a path. Throws std::invalid_argument, with the allowed form.
PortAddress parse_address(const std::string& text, const std::string& usual_port);

/// The address with a port that is a word of its own, as for telnet. Throws std::invalid_argument
/// if the address has one already, or the port is invalid.
PortAddress with_port(const PortAddress& address, const std::string& port);

}  // namespace xr3
