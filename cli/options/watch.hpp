// The command line of `xr3 watch`.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/address.hpp"
#include "cli/options/cli_fwd.hpp"

namespace xr3 {

struct WatchOptions {
  PortAddress address{"localhost:9601", "localhost", "9601", true};
  std::string cell;          ///< empty for the server's first
  std::string token_file;    ///< empty for the token in XR3_TOKEN, if any
  bool is_once = false;      ///< print one screen as text, then exit
  bool shows_lines = false;  ///< whether it begins with the serial lines
  bool is_plain = false;     ///< no colours
  bool is_ascii = false;     ///< ASCII characters only
};

/// Adds the subcommand `watch` with its options.
void add_watch(CLI::App& app, WatchOptions& options);

}  // namespace xr3
