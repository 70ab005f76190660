#include "server/options/watch.hpp"

#include <CLI/CLI.hpp>
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

std::string check_address(const std::string& text) {
  WatchOptions unused;
  try {
    set_address(unused, text);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

}  // namespace

// With a port, an IPv6 address must be in brackets, since it contains colons itself.
void set_address(WatchOptions& options, const std::string& address) {
  std::string host = address;
  std::string port = "9601";
  const std::size_t colon = address.rfind(':');
  const bool is_bare_ipv6 = address.find(':') != colon && !address.starts_with('[');
  const bool has_port = colon != std::string::npos && !is_bare_ipv6 && !address.ends_with(']');
  if (has_port) {
    host = address.substr(0, colon);
    port = address.substr(colon + 1);
  }
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.empty() || !is_port(port)) {
    throw std::invalid_argument(address + ": an address is HOST:PORT, as in localhost:9601");
  }
  options.address = address;
  options.host = host;
  options.port = port;
}

void add_watch(CLI::App& app, WatchOptions& options) {
  CLI::App& watch =
      *app.add_subcommand("watch", "show a robot in the terminal, through its monitor port");
  watch
      .add_option_function<std::string>(
          "address", [&options](const std::string& text) { set_address(options, text); },
          "the monitor port (default localhost:9601)")
      ->type_name("HOST:PORT")
      ->check(CLI::Validator(check_address, ""));
  watch.add_option("--cell", options.cell, "the cell to show (default: the server's first)")
      ->type_name("NAME");
  watch
      .add_option("--token-file", options.token_file,
                  "file with the token, needed by keys that make calls (default: XR3_TOKEN)")
      ->type_name("FILE");
  watch.add_flag("--once", options.is_once, "print one screen as text and exit");
  watch.add_flag("--no-color", options.is_plain, "no colours; NO_COLOR does the same");
  watch.add_flag("--ascii", options.is_ascii, "use only ASCII characters");
}

}  // namespace xr3
