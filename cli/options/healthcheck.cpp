#include "cli/options/healthcheck.hpp"

#include <cassert>

#include "cli/options/config.hpp"
#include "cli/options/environment.hpp"
#include "cli/options/shared_options.hpp"
#include "server/net/asio.hpp"

namespace xr3 {
namespace {

constexpr double kMaxWaitS = 86'400;

// Chooses the port: --monitor-port as an argument overrides a port file from the environment or the
// config file.
void choose_port(const CLI::App& health, HealthOptions& options) {
  const bool is_port_given = is_argument(health, "--monitor-port");
  if (is_port_given && !is_argument(health, "--port-file")) options.port_file.clear();
  if (options.port_file.empty() && options.monitor_port == 0) {
    throw CLI::ValidationError(
        "port 0 selects a free port: use --port-file with the file that serve wrote");
  }
}

void complete(CLI::App& health, HealthOptions& options) {
  OptionSources option_sources = complete_from_environment(health);
  read_config(health, options.config, OtherKeys::kSkip, option_sources);
  choose_port(health, options);
}

}  // namespace

void add_health(CLI::App& app, HealthOptions& options) {
  CLI::App& health = *app.add_subcommand(
      "healthcheck", "check that the server on this machine serves lines; exit code 0 if it does");
  add_value(health, "--listen", options.listen, "ADDR", "address of the server, as for serve")
      ->check(CLI::Validator(check_listen, ""))
      ->capture_default_str();
  add_value(health, "--monitor-port", options.monitor_port, "PORT", "its monitor port")
      ->check(CLI::Validator(check_port, ""))
      ->capture_default_str();
  add_value(health, "--port-file", options.port_file, "FILE",
            "read the port from this file, which serve wrote");
  add_value(health, "--wait", options.wait_s, "SECONDS",
            "retry for this many seconds until the server is ready")
      ->check(number_between(0, kMaxWaitS))
      ->configurable(false);
  add_config(health, options.config);
  read_environment(health, {"--wait"});
  health.parse_complete_callback([&health, &options] { complete(health, options); });
}

std::string address_to_ask(const std::string& listen) {
  assert(check_listen(listen).empty());
  if (listen == "localhost" || listen == "0.0.0.0") return "127.0.0.1";
  const bool is_any = asio::ip::make_address(listen).is_unspecified();
  return is_any ? "::1" : listen;
}

}  // namespace xr3
