#include "protocol/line/com_port_codes.hpp"

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {

void append_com_port(std::string& out, std::uint8_t code, std::span<const std::uint8_t> value) {
  for (const std::uint8_t byte : {telnet::kIac, telnet::kSb, telnet::kComPort, code}) {
    out.push_back(static_cast<char>(byte));
  }
  for (const std::uint8_t byte : value) {
    if (byte == telnet::kIac) out.push_back(static_cast<char>(byte));
    out.push_back(static_cast<char>(byte));
  }
  out.push_back(static_cast<char>(telnet::kIac));
  out.push_back(static_cast<char>(telnet::kSe));
}

}  // namespace xr3
