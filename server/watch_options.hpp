// The command line of `xr3 watch`.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

namespace xr3 {

struct WatchOptions {
  std::string address = "localhost:9601";  ///< HOST, HOST:PORT or [IPv6]:PORT, as given
  std::string host = "localhost";
  std::string port = "9601";
  std::string cell;        ///< empty: the one that the server names
  std::string token_file;  ///< empty: what XR3_TOKEN holds, if anything
  bool is_once = false;    ///< one screen as text, then leave
  bool is_plain = false;   ///< no colours
  bool is_ascii = false;   ///< no letters beyond ASCII
};

/// The subcommand `watch` with its options.
void add_watch(CLI::App& app, WatchOptions& options);

/// Host and port out of an address. Throws std::invalid_argument with what is allowed.
void set_address(WatchOptions& options, const std::string& address);

}  // namespace xr3
