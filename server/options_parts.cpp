#include "server/options_parts.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "server/asio.hpp"

namespace xr3 {

std::string check_listen(const std::string& text) {
  ErrorCode error;
  if (text != "localhost") asio::ip::make_address(text, error);
  return error ? text + " is not an address; give one such as 127.0.0.1 or ::1" : "";
}

std::string check_port(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  const bool is_port = error == std::errc{} && end == text.data() + text.size();
  return is_port ? "" : text + ": a port is a number from 0 to 65535";
}

bool is_argument(const CLI::App& command, const std::string& name) {
  const std::vector<CLI::Option*>& said = command.parse_order();
  return std::find(said.begin(), said.end(), command.get_option(name)) != said.end();
}

}  // namespace xr3
