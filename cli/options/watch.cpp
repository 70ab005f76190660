#include "cli/options/watch.hpp"

#include <CLI/CLI.hpp>

#include "cli/options/shared_options.hpp"

namespace xr3 {
namespace {

PortAddress parse_monitor_address(const std::string& text) { return parse_address(text, "9601"); }

}  // namespace

void add_watch(CLI::App& app, WatchOptions& options) {
  CLI::App& watch =
      *app.add_subcommand("watch", "show a robot in the terminal, through its monitor port");
  add_parsed(watch, "address", options.address, parse_monitor_address, "HOST:PORT|PORT",
             "the monitor port, or the address of its page (default localhost:9601)");
  add_port_word(watch, [&options](const std::string& port) {
    options.address = with_port(options.address, port);
  });
  add_value(watch, "--cell", options.cell, "NAME",
            "the cell to show (default: the server's first)");
  add_value(watch, "--token-file", options.token_file, "FILE",
            "file with the server's token (default: XR3_TOKEN); the key t asks for it");
  watch.add_flag("--lines", options.shows_lines, "begin with the serial lines, as the key l");
  watch.add_flag("--once", options.is_once, "print one screen as text and exit");
  watch.add_flag("--no-color", options.is_plain, "no colours; NO_COLOR does the same");
  watch.add_flag("--ascii", options.is_ascii, "use only ASCII characters");
}

}  // namespace xr3
