#include "server/app.hpp"

#include <spdlog/spdlog.h>

#include <csignal>
#include <iostream>
#include <utility>

#include "server/log.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// Maximum time for clients to read their last replies before the process ends.
constexpr WallNs kDrainLimit = 1'000'000'000;
// Maximum time for the sessions to notice that they were aborted.
constexpr std::chrono::milliseconds kAbortLimit{200};
// Enough memory to log one message.
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

// Listens on ::1, too, at the same port. Failure is ignored, since there may be no IPv6. But if the
// user chose the port and another program has it on ::1, clients of localhost would reach that
// program.
template <class Port>
void listen_too(Port& port, const std::string& what, bool was_chosen) {
  const tcp::endpoint endpoint{asio::ip::address_v6::loopback(), port.endpoint().port()};
  const ErrorCode error = port.listen(endpoint);
  if (error == asio::error::address_in_use && was_chosen) throw listen_error(what, endpoint, error);
}

AccessRules access_rules(const ServeOptions& options, std::string token) {
  const auto reach = is_loopback(options.listen) ? http::Reach::kThisMachine : http::Reach::kBeyond;
  return {{reach, options.allow_hosts, options.allow_origins},
          options.is_private ? Reading::kWithToken : Reading::kFree,
          std::move(token)};
}

// nohup starts a program with SIGHUP ignored, so that it survives the end of the terminal.
bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

SocketLimits socket_limits(const ServeOptions& options) {
  SocketLimits wanted;
  wanted.lines = options.max_lines;
  wanted.per_address = options.max_per_address;
  const std::size_t descriptors = raise_descriptor_limit();
  const SocketLimits limits = divide_descriptors(descriptors, wanted);
  if (limits.connections < wanted.connections) {
    spdlog::warn(
        "the limit of {} open files allows only {} lines and {} monitor connections; raise it with "
        "ulimit -n, or LimitNOFILE= of systemd",
        descriptors, limits.lines, limits.connections);
  }
  return limits;
}

}  // namespace

App::App(const ServeOptions& options, ModelPtr model, std::string token)
    : options_(options),
      fresh_token_(std::holds_alternative<FreshToken>(options.token) ? token : ""),
      reserve_(std::make_unique<char[]>(kReserveBytes)),
      cell_("main", std::move(model), start_clock(options.clock),
            [this](const CellEvent& event, const Model& its) {
              if (!is_replaying_) log_event(event, its);
            }),
      policy_(access_rules(options, std::move(token))),
      limits_(socket_limits(options)),
      memory_(io_, options.max_memory_mib << 20, [this] { return close_greediest(); }),
      lines_(io_, cell_, [this] { acted(); }),
      due_timer_(io_, cell_, [this] { acted(); }),
      robot_port_(io_, cell_, lines_,
                  {limits_.lines, options.guard, peer_counts(limits_.lines, limits_.per_address)}),
      ptys_(io_, lines_),
      robot_probe_(io_, robot_port_),
      monitor_port_(
          io_, cell_, lines_, policy_, [this] { return not_ready(); }, [this] { acted(); },
          limits_),
      service_manager_(io_, service_environment(), [this] { return robot_probe_.failure(); }),
      signals_(io_, SIGINT, SIGTERM) {
  if (options_.line_speed) cell_.set_line_speed(*options_.line_speed);
  lines_.limit_memory(memory_);
  monitor_port_.limit_memory(memory_);
}

// Destroys waiting handlers and coroutines before the members that they refer to. The cell may be
// half changed, so it is frozen first and ignores the inputs of the sessions that end here.
App::~App() {
  stage_ = Stage::kEnded;
  cell_.freeze();
  monitor_port_.stop();
  io_.shutdown();
  lines_.drop();
}

ExitCode App::run() {
  return_freed_blocks();
  listen();
  open_terminals();
  connect_device();
  start_recording();
  open_device();
  await_signal();
  announce();
  const ExitCode code = serve();
  if (recording_ && code == ExitCode::kGood) recording_->finish();
  return code;
}

void App::begin_with(const std::function<void(Cell&)>& replay) {
  is_replaying_ = true;
  replay(cell_);
  while (!cell_.lines().empty())
    cell_.apply(LineClosed{cell_.lines().begin()->first, LineCloseReason::kShutdown}, 0);
  is_replaying_ = false;
  cell_.end_replay(wall_now());
}

ExitCode App::serve() {
  try {
    while (io_.run_one() > 0) lines_.run_due_turns();
    return ExitCode::kGood;
  } catch (const std::exception& failure) {
    return break_off(failure.what());
  } catch (...) {
    return break_off("an exception of unknown type");
  }
}

// Sends nothing to clients: the objects needed for that may be the ones that failed.
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

void App::open_terminals() {
  with_option_source(options_.option_sources, "--pty",
                     [&] { ptys_.serve(options_.ptys, options_.pty_mode); });
}

void App::connect_device() {
  if (!options_.device) return;
  device_.emplace(io_, cell_, options_.device->path, options_.device->settings,
                  options_.is_mirrored, [this] { acted(); });
}

void App::start_recording() {
  if (options_.record.empty()) return;
  with_option_source(options_.option_sources, "--record", [&] {
    recording_.emplace(io_, cell_, options_.record, std::uint64_t{options_.record_max_mib} << 20U,
                       [this] { acted(); });
  });
}

void App::open_device() {
  if (!device_) return;
  with_option_source(options_.option_sources, "--serial", [&] { device_->open(); });
}

// Called when everything is ready: programs may connect as soon as they see this line or the file.
void App::announce() {
  stage_ = Stage::kReady;
  const tcp::endpoint robot = robot_port_.endpoint();
  const tcp::endpoint monitor = monitor_port_.endpoint();
  if (!options_.port_file.empty()) {
    with_option_source(options_.option_sources, "--port-file", [&] {
      const ServedPorts ports{robot.port(), monitor.port(), fresh_token_};
      port_file_.emplace(options_.port_file, ports);
    });
  }
  announce_token(monitor.port());
  std::cout << "LISTENING robot=" << to_text(robot) << " monitor=" << to_text(monitor);
  for (const std::string& path : options_.ptys) std::cout << " pty=" << path;
  std::cout << std::endl;
  service_manager_.ready();
}

// Bypasses the log, which may be stored. Standard output contains only the LISTENING line.
void App::announce_token(std::uint16_t monitor_port) const {
  if (fresh_token_.empty()) return;
  std::cerr << "xr3: calls need this run's token; open http://localhost:" << monitor_port
            << "/#token=" << fresh_token_ << std::endl;
}

void App::await_signal() {
  if (!is_ignored(SIGHUP)) signals_.add(SIGHUP);
  signals_.async_wait([this](ErrorCode cancelled, int signal) {
    if (cancelled) return;
    spdlog::info("signal {}: stopping", signal);
    stop();
  });
}

void App::acted() {
  if (stage_ == Stage::kEnded) return;
  for (const LineId line : cell_.take_woken_lines()) lines_.wake(line);
  due_timer_.update();
  if (device_) device_->pump();
  if (stage_ != Stage::kDraining) return monitor_port_.acted();
  if (lines_.is_empty() && monitor_port_.is_empty()) drain_limit_.cancel();
}

std::size_t App::close_greediest() {
  const std::size_t of_lines = lines_.most_held();
  const std::size_t of_monitor = monitor_port_.most_held();
  if (of_lines == 0 && of_monitor == 0) return 0;
  of_lines > of_monitor ? lines_.close_greediest() : monitor_port_.close_greediest();
  return std::max(of_lines, of_monitor);
}

// Closes everything that keeps the event loop running, so that run() returns.
void App::stop() {
  stage_ = Stage::kDraining;
  service_manager_.stopping();
  port_file_.reset();
  const WallNs deadline = wall_now() + kDrainLimit;
  robot_port_.close();
  ptys_.close();
  due_timer_.close();
  if (device_) device_->close();
  lines_.close(deadline - kDrainLimit / 2);
  monitor_port_.close(deadline);
  if (lines_.is_empty() && monitor_port_.is_empty()) return;
  drain_limit_.expires_at(as_time_point(deadline));
  drain_limit_.async_wait([this](ErrorCode cancelled) {
    lines_.abort();  // no effect if the wait was cancelled: all have ended
    monitor_port_.abort();
    if (!cancelled) end_soon();
  });
}

// Sessions end by themselves when they are resumed. But requests may wait for the worker, for long.
void App::end_soon() {
  drain_limit_.expires_after(kAbortLimit);
  drain_limit_.async_wait([this](ErrorCode cancelled) {
    if (!cancelled) io_.stop();
  });
}

}  // namespace xr3
