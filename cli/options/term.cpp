#include "cli/options/term.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <utility>

#include "cli/options/shared_options.hpp"

namespace xr3 {
namespace {

constexpr const char* kUsualRobotPort = "9600";
constexpr double kMinTimeoutS = 0.1;
constexpr double kMaxTimeoutS = 3600;

bool is_path(const std::string& text) { return text.starts_with('/') || text.starts_with('.'); }

void set_address(TermOptions& options, PortAddress address) {
  options.peer = address.text;
  options.address = std::move(address);
}

void set_peer(TermOptions& options, const std::string& text) {
  options.peer = text;
  options.is_path = is_path(text);
  if (!options.is_path) set_address(options, parse_address(text, kUsualRobotPort));
}

void set_port(TermOptions& options, const std::string& port) {
  if (options.is_path) throw std::invalid_argument(options.peer + ": a path has no port: " + port);
  set_address(options, with_port(options.address, port));
}

SerialSettings parse_line_settings(const std::string& text) {
  auto settings = parse_serial_settings(text);
  if (!settings) {
    throw std::invalid_argument(text +
                                ": settings are a speed and a frame, as in 9600-7e2 or 9600-8n1");
  }
  if (!settings->frame) settings->frame = SerialFrame{};
  return *settings;
}

void add_peer(CLI::App& term, TermOptions& options) {
  term.add_option_function<std::string>(
          "peer", [&options](const std::string& text) { set_peer(options, text); },
          "the robot port (default localhost:9600), or a serial device or pseudo-terminal")
      ->type_name("HOST:PORT|PORT|PATH")
      ->check(parses([](const std::string& text) {
        TermOptions unused;
        set_peer(unused, text);
      }));
  add_port_word(term, [&options](const std::string& port) { set_port(options, port); });
  term.add_flag("--rfc2217", options.is_rfc2217,
                "HOST:PORT is a terminal server: set up its serial port (RFC 2217)");
  add_parsed(term, "--line-settings", options.settings, parse_line_settings, "SETTINGS",
             "speed and frame of the serial port (default 9600-7e2)");
}

// Checks options against each other: the line's settings have no effect on a plain TCP connection.
void check_consistency(const CLI::App& term, const TermOptions& options) {
  if (options.is_path && options.is_rfc2217) {
    throw CLI::ValidationError("--rfc2217 needs HOST:PORT, not a path");
  }
  const bool has_settings = term.get_option("--line-settings")->count() > 0;
  if (has_settings && !options.is_path && !options.is_rfc2217) {
    throw CLI::ValidationError("--line-settings needs a serial device, or --rfc2217");
  }
}

}  // namespace

void add_term(CLI::App& app, TermOptions& options) {
  set_peer(options, options.peer);
  CLI::App& term = *app.add_subcommand(
      "term", "talk to a robot: keys go to its serial line, replies come decoded");
  add_peer(term, options);
  CLI::Option* text = term.add_flag_callback(
      "--text", [&options] { options.view = TermView::kText; }, "decode replies (default)");
  CLI::Option* hex = term.add_flag_callback(
      "--hex", [&options] { options.view = TermView::kHex; }, "show the bytes of both directions");
  CLI::Option* raw = term.add_flag_callback(
      "--raw", [&options] { options.view = TermView::kRaw; }, "write the replies unchanged");
  text->excludes(hex)->excludes(raw);
  hex->excludes(raw);
  term.add_flag("--line", options.edits_lines,
                "edit lines, with a history, and send each at Enter");
  add_value(term, "--robot", options.robot, "NAME|FILE",
            "the robot of the line, for the names of its switches and its camera");
  add_value(term, "--workcell", options.workcell, "NAME|FILE",
            "its workcell, for its camera, or none (default: the one named after the robot, or "
            "none)");
  add_profile(term, options.profile);
  add_value(term, "--timeout", options.timeout_s, "SECONDS",
            "how long to wait for a reply, in seconds")
      ->check(number_between(kMinTimeoutS, kMaxTimeoutS))
      ->capture_default_str();
  term.parse_complete_callback([&term, &options] { check_consistency(term, options); });
}

}  // namespace xr3
