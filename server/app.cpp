#include "server/app.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <utility>

#include "protocol/files/paper_form/paper_form.hpp"
#include "server/files/data_files.hpp"
#include "server/files/port_file.hpp"
#include "server/log.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// Clients that do not take their last replies keep the process no longer than this.
constexpr std::chrono::milliseconds kDrainLimit{1000};
// What a line of the log and its stream may need.
constexpr std::size_t kReserveBytes = std::size_t{256} * 1024;

SimClock start_clock(const ClockChoice& choice) {
  return choice.mode == ClockMode::kManual ? SimClock::manual()
                                           : SimClock::real(choice.rate, wall_now());
}

ListenError listen_error(const std::string& what, const tcp::endpoint& endpoint, ErrorCode error) {
  if (error == asio::error::address_in_use) {
    return {ExitCode::kPortInUse,
            what + " port " + to_text(endpoint) +
                " is in use by another program; choose another, or 0 for a free one"};
  }
  return {ExitCode::kBadInput, "cannot listen on " + to_text(endpoint) + " for the " + what +
                                   " port: " + error.message()};
}

template <class Port>
void listen_on(Port& port, const std::string& what, const tcp::endpoint& endpoint) {
  if (const ErrorCode error = port.listen(endpoint)) throw listen_error(what, endpoint, error);
}

// On ::1 as well, at the same port. Without IPv6 nobody misses it; but whoever asks for localhost must
// not get to another program where the port was chosen.
template <class Port>
void listen_too(Port& port, const std::string& what, bool was_chosen) {
  const tcp::endpoint endpoint{asio::ip::address_v6::loopback(), port.endpoint().port()};
  const ErrorCode error = port.listen(endpoint);
  if (error == asio::error::address_in_use && was_chosen) throw listen_error(what, endpoint, error);
}

std::string workcell_name(const ServeOptions& options) {
  if (!options.workcell.empty()) return options.workcell;
  std::string name = std::filesystem::path(options.robot).stem();
  if (has_data_file(name, "workcells")) return name;
  throw FileError("there is no workcell named after the robot " + name + "; name one with --workcell");
}

AccessRules access_rules(const ServeOptions& options, std::string token) {
  const auto reach = is_loopback(options.listen) ? http::Reach::kThisMachine : http::Reach::kBeyond;
  return {{reach, options.allow_hosts, options.allow_origins},
          options.is_private ? Reading::kWithToken : Reading::kFree,
          std::move(token)};
}

}  // namespace

ModelPtr load_model(const ServeOptions& options) {
  const DataFile robot_file = with_option_source(
      options.option_sources, "--robot", [&] { return find_data_file(options.robot, "robots"); });
  const Robot robot = load_robot_of_either_form(robot_file.text, robot_file.path);
  const DataFile workcell_file = with_option_source(options.option_sources, "--workcell", [&] {
    return find_data_file(workcell_name(options), "workcells");
  });
  const Workcell workcell = load_workcell_of_either_form(workcell_file.text, workcell_file.path);
  return std::make_shared<const Model>(robot, workcell, options.profile);
}

App::App(const ServeOptions& options, ModelPtr model, std::string token)
    : options_(options),
      fresh_token_(std::holds_alternative<FreshToken>(options.token) ? token : ""),
      reserve_(std::make_unique<char[]>(kReserveBytes)),
      cell_("main", std::move(model), start_clock(options.clock), log_event),
      policy_(access_rules(options, std::move(token))),
      robot_port_(io_, cell_, options.max_lines, [this] { acted(); }),
      robot_probe_(io_, robot_port_),
      monitor_port_(
          io_, cell_, robot_port_, policy_, [this] { return not_ready(); }, [this] { acted(); }),
      signals_(io_, SIGINT, SIGTERM) {}

// What waits is destroyed first, since it refers to the members. Sessions that end by it find a cell that
// takes nothing: it may be half changed.
App::~App() {
  stage_ = Stage::kEnded;
  cell_.freeze();
  monitor_port_.stop();
  io_.shutdown();
}

ExitCode App::run() {
  listen();
  await_signal();
  announce();
  return serve();
}

ExitCode App::serve() {
  try {
    io_.run();
    return ExitCode::kGood;
  } catch (const std::exception& failure) {
    return break_off(failure.what());
  } catch (...) {
    return break_off("an exception of unknown type");
  }
}

// No further word to anybody: what the words would be made of may be what has failed.
ExitCode App::break_off(const char* what) {
  reserve_.reset();
  spdlog::critical("the server has failed and ends: {}", what);
  return ExitCode::kBroken;
}

asio::awaitable<std::string> App::not_ready() {
  if (stage_ != Stage::kReady) co_return "the server is starting or stopping";
  std::string trouble = co_await robot_probe_.trouble();
  co_return trouble;
}

void App::listen() {
  const bool is_local = options_.listen == "localhost";
  const auto address = asio::ip::make_address(is_local ? "127.0.0.1" : options_.listen);
  listen_on(robot_port_, "robot", {address, options_.robot_port});
  listen_on(monitor_port_, "monitor", {address, options_.monitor_port});
  if (!is_local) return;
  listen_too(robot_port_, "robot", options_.robot_port != 0);
  listen_too(monitor_port_, "monitor", options_.monitor_port != 0);
}

// Only when everything is ready: whoever waits for this line or this file may connect at once.
void App::announce() {
  stage_ = Stage::kReady;
  const tcp::endpoint robot = robot_port_.endpoint();
  const tcp::endpoint monitor = monitor_port_.endpoint();
  if (!options_.port_file.empty()) {
    with_option_source(options_.option_sources, "--port-file", [&] {
      write_port_file(options_.port_file, {robot.port(), monitor.port(), fresh_token_});
    });
  }
  announce_token(monitor.port());
  std::cout << "LISTENING robot=" << to_text(robot) << " monitor=" << to_text(monitor) << std::endl;
}

// Past the log, which may be kept: this is for whoever started the process. It never goes to standard
// output, which has one line only.
void App::announce_token(std::uint16_t monitor_port) const {
  if (fresh_token_.empty()) return;
  std::cerr << "xr3: calls need this run's token; open http://localhost:" << monitor_port
            << "/#token=" << fresh_token_ << std::endl;
}

void App::await_signal() {
  signals_.async_wait([this](ErrorCode cancelled, int signal) {
    if (cancelled) return;
    spdlog::info("signal {}: stopping", signal);
    stop();
  });
}

void App::acted() {
  if (stage_ == Stage::kEnded) return;
  if (stage_ != Stage::kDraining) return monitor_port_.subscribers().acted();
  if (robot_port_.is_empty() && monitor_port_.is_empty()) drain_limit_.cancel();
}

// Everything that keeps the loop alive is closed, so that run() returns by itself.
void App::stop() {
  stage_ = Stage::kDraining;
  monitor_port_.subscribers().stop();
  robot_port_.close();
  monitor_port_.close();
  if (robot_port_.is_empty() && monitor_port_.is_empty()) return;
  drain_limit_.expires_after(kDrainLimit);
  drain_limit_.async_wait([this](ErrorCode) {
    robot_port_.abort();  // none are left if the wait was cancelled
    monitor_port_.abort();
  });
}

}  // namespace xr3
