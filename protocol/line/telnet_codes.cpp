#include "protocol/line/telnet_codes.hpp"

#include <array>

namespace xr3 {

void append_escaped(std::string& out, std::string_view data) {
  for (const char byte : data) {
    out.push_back(byte);
    if (static_cast<std::uint8_t>(byte) == telnet::kIac) out.push_back(byte);
  }
}

void append_com_port(std::string& out, std::uint8_t code, std::span<const std::uint8_t> value) {
  for (const std::uint8_t byte : {telnet::kIac, telnet::kSb, telnet::kComPort, code}) {
    out.push_back(static_cast<char>(byte));
  }
  append_escaped(out, {reinterpret_cast<const char*>(value.data()), value.size()});
  out.push_back(static_cast<char>(telnet::kIac));
  out.push_back(static_cast<char>(telnet::kSe));
}

void append_baud(std::string& out, std::uint8_t code, std::uint32_t baud) {
  std::array<std::uint8_t, 4> value{};
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = static_cast<std::uint8_t>(baud >> (24 - 8 * i));
  append_com_port(out, code, value);
}

}  // namespace xr3
