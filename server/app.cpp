#include "server/app.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <utility>

#include "server/log.hpp"
#include "server/net/spawn.hpp"
#include "server/net/standard_input.hpp"
#include "server/net/wall_clock.hpp"
#include "server/options/cell_tokens.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

// Maximum time for clients to read their last replies before the process ends.
constexpr WallNs kDrainLimit = 1'000'000'000;
// Maximum time for the sessions to end after an abort.
constexpr std::chrono::milliseconds kAbortLimit{200};
// Memory that suffices to log one message.
constexpr std::size_t kReserveBytes = std::size_t{256} * 1024;
// The part of the memory that the rings of all cells may have together: an eighth.
constexpr std::size_t kRingsPart = 8;
// The memory that the histories of all cells may have together: 64 MiB, or an eighth.
constexpr std::size_t kHistoryBytes = std::size_t{64} * 1024 * 1024;
constexpr std::size_t kAddressesOfPort = 2;  // 127.0.0.1 and ::1

ExitError listen_error(const std::string& what, const tcp::endpoint& endpoint, ErrorCode error) {
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

void warn_of_open_token(const std::string& file) {
  if (others_may_read(file))
    spdlog::warn("{}: every user of this machine can read the token; set mode 600", file);
}

/// The token for /metrics; empty if there is none.
std::string metrics_token(const ServeOptions& options) {
  if (options.metrics_token_file.empty()) return {};
  warn_of_open_token(options.metrics_token_file);
  return with_option_source(options.option_sources, "--metrics-token-file",
                            [&] { return read_token(TokenFile{options.metrics_token_file}); });
}

AccessRules access_rules(const ServeOptions& options, std::string token) {
  if (const auto* file = std::get_if<TokenFile>(&options.token)) warn_of_open_token(file->path);
  const auto reach =
      is_loopback(options.listen) ? http::HostReach::kThisMachine : http::HostReach::kBeyond;
  return {{reach, options.allow_hosts, options.allow_origins},
          options.is_private ? ReadAccess::kWithToken : ReadAccess::kFree,
          std::move(token),
          metrics_token(options),
          options.allow_frames};
}

asio::ip::address address_of(const std::string& listen) {
  return asio::ip::make_address(listen == "localhost" ? "127.0.0.1" : listen);
}

/// Listens at the address of the option --listen; for localhost at both of its addresses.
template <class Port>
void listen_at(Port& port, const std::string& what, const std::string& listen,
               std::uint16_t number) {
  listen_on(port, what, {address_of(listen), number});
  if (listen == "localhost") listen_too(port, what, number != 0);
}

/// The address of the page for a browser on this machine.
std::string page_address(const tcp::endpoint& monitor) {
  const asio::ip::address at = monitor.address();
  const bool is_local = at.is_loopback() || at.is_unspecified();
  return "http://" + (is_local ? "localhost:" + std::to_string(monitor.port()) : to_text(monitor)) +
         "/";
}

// Whether a signal is ignored. nohup starts a program with SIGHUP ignored, so that it survives the
// end of the terminal.
bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

std::vector<CellPlan> plans_with_tokens(const ServeOptions& options) {
  std::vector<CellPlan> plans = plan_cells(options);
  with_option_source(options.option_sources, "--roster", [&] { assign_tokens(options, plans); });
  return plans;
}

/// The maximum number of branches at a time.
std::size_t most_branches(const ServeOptions& options, std::size_t cells) {
  if (options.history_ticks == 0) return 0;
  if (options.is_cell_per_connection) return options.max_cells;
  return std::min(options.max_cells - std::min(options.max_cells, cells),
                  cells * BranchCells::kMostPerOrigin);
}

SocketLimits socket_limits(const ServeOptions& options, std::size_t cells) {
  SocketLimits wanted;
  wanted.lines = options.max_lines;
  wanted.per_address = options.max_per_address;
  wanted.branches = most_branches(options, cells);
  const std::size_t descriptors = raise_descriptor_limit();
  const bool has_one_port = cells <= 1 || options.is_cell_per_connection;
  const std::size_t listeners = has_one_port ? 0 : kAddressesOfPort * (cells - 1);
  const SocketLimits limits = divide_descriptors(descriptors, wanted, listeners);
  if (limits.connections < wanted.connections) {
    spdlog::warn(
        "the limit of {} open files allows only {} lines and {} monitor connections; raise it with "
        "ulimit -n, or LimitNOFILE= of systemd",
        descriptors, limits.lines, limits.connections);
  }
  return limits;
}

}  // namespace

App::App(const ServeOptions& options, std::vector<CellSeed> seeds, std::string token)
    : options_(options),
      plans_(plans_with_tokens(options)),
      seeds_(std::move(seeds)),
      fresh_token_(std::holds_alternative<FreshToken>(options.token) ? token : ""),
      reserve_(std::make_unique<char[]>(kReserveBytes)),
      policy_(access_rules(options, std::move(token))),
      record_room_(std::uint64_t{options.record_total_mib} << 20U),
      limits_(socket_limits(options, plans_.size())),
      memory_(io_, options.max_memory_mib << 20, [this] { return close_greediest(); }),
      rings_((options.max_memory_mib << 20) / kRingsPart),
      histories_(std::min(kHistoryBytes, (options.max_memory_mib << 20) / kRingsPart)),
      context_{io_,     turns_,     worker_, [this](HostedCell& cell) { after_input(cell); },
               &rings_, &histories_},
      comebacks_(io_, [this](HostedCell& cell) { begin_again(cell); }),
      retention_(io_, options.record, options.record_keep_days,
                 [this](const std::string& path) { return comebacks_.needs(path); }),
      monitor_port_(
          io_, cells_, worker_, policy_, [this] { return not_ready(); }, [this] { ended(); },
          limits_),
      branch_cells_(io_, linger_of(options_), [this](const CellPtr& cell) { close_cell(cell); }),
      service_manager_(io_, service_environment()),
      signals_(io_, SIGINT, SIGTERM) {
  turns_.limit_memory(memory_);
  monitor_port_.limit_memory(memory_);
  monitor_port_.service().count_more([this](CellCounters& counters) { count_more(counters); });
  monitor_port_.service().past_calls().branch_by(
      [this](HostedCell& of, MachineSnapshotPtr past) { return open_branch(of, std::move(past)); });
  check_byte_clock();
  if (options_.is_cell_per_connection) serve_connections();
  open_planned();
}

// Destroys waiting handlers and coroutines before the members that they refer to. The cell may be
// half changed, so it is frozen first and ignores the inputs of the sessions that end here.
App::~App() {
  stage_ = Stage::kEnded;
  for (const CellPtr& each : cells_.all()) each->freeze();
  comebacks_.stop();
  worker_.stop();
  io_.shutdown();
  for (const CellPtr& each : cells_.all()) each->lines().drop();
}

ExitCode App::run() {
  return_freed_blocks();
  listen();
  open_terminals();
  connect_device();
  start_recordings();
  keep_histories();
  open_device();
  await_signal();
  if (options_.is_until_stdin_ends)
    spawn_loop(io_.get_executor(), "standard input", await_end_of_input());
  announce();
  const ExitCode code = serve();
  if (code != ExitCode::kGood) return code;
  for (const CellPtr& each : cells_.all()) each->finish_recording();
  return code;
}

void App::begin_with(const std::function<void(Cell&)>& replay) {
  keep_histories();  // before the replay, so that recorded inputs are the past
  is_replaying_ = true;
  Cell& cell = first().cell();
  replay(cell);
  while (!cell.lines().empty())
    cell.apply(LineClosed{cell.lines().begin()->first, LineCloseReason::kShutdown}, 0);
  is_replaying_ = false;
  cell.end_replay(wall_now());
}

ExitCode App::serve() {
  try {
    while (io_.run_one() > 0) turns_.run_due_turns();
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

void App::listen() {
  if (connection_cells_)
    listen_at(*connection_cells_, "robot", options_.listen, options_.robot_port);
  for (const CellPlan& plan : plans_) {
    HostedCell& cell = *cells_.find(plan.name);
    connection_cells_ ? cell.port()->share(connection_cells_->endpoint())
                      : listen_on_cell(cell, plan.port);
  }
  listen_at(monitor_port_, "monitor", options_.listen, options_.monitor_port);
  page_ = page_address(monitor_endpoint());
}

void App::listen_on_cell(HostedCell& cell, std::uint16_t port) {
  const std::string what = plans_.size() > 1 ? "cell " + cell.name() + ": robot" : "robot";
  listen_at(*cell.port(), what, options_.listen, port);
}

void App::open_terminals() {
  if (options_.ptys.empty()) return;
  with_option_source(options_.option_sources, "--pty",
                     [&] { first().serve_terminals(options_.ptys, options_.pty_mode); });
}

void App::connect_device() {
  if (options_.device) first().connect_device(*options_.device, options_.is_mirrored);
}

void App::open_device() {
  if (!options_.device) return;
  with_option_source(options_.option_sources, "--serial", [&] { first().open_device(); });
}

// Called when all ports are open: programs may connect as soon as they see this line or the file.
void App::announce() {
  stage_ = Stage::kReady;
  const tcp::endpoint robot = robot_endpoint();
  const tcp::endpoint monitor = monitor_port_.endpoint();
  if (!options_.port_file.empty()) {
    with_option_source(options_.option_sources, "--port-file",
                       [&] { port_file_.emplace(options_.port_file, served_ports()); });
  }
  announce_token();
  std::string ports = "LISTENING robot=" + to_text(robot) + " monitor=" + to_text(monitor);
  for (const std::string& path : options_.ptys) ports += " pty=" + path;
  print_text(ports + "\n");
  announce_page();
  service_manager_.ready();
}

// Bypasses the log, which may be stored. Standard output contains only the LISTENING line.
void App::announce_token() const {
  if (fresh_token_.empty()) return;
  print_error("xr3: calls need this run's token; open " + page_ + "#token=" + fresh_token_ + "\n");
}

/// Prints the address of the page for a user, or logs it where the log of level info is read.
void App::announce_page() const {
  const bool is_logged = options_.log_file.empty() && spdlog::should_log(spdlog::level::info);
  if (!fresh_token_.empty() || (!is_logged && ::isatty(STDERR_FILENO) == 0)) return;
  print_error("xr3: open " + page_ + "\n");
}

void App::await_signal() {
  if (!is_ignored(SIGHUP)) signals_.add(SIGHUP);
  signals_.async_wait([this](ErrorCode cancelled, int signal) {
    if (cancelled) return;
    spdlog::info("signal {}: stopping", signal);
    stop();
  });
}

asio::awaitable<void> App::await_end_of_input() {
  StandardInput input(io_);
  while (true) {
    const std::string_view bytes = co_await input.read();
    if (bytes.empty()) break;
  }
  spdlog::info("standard input has ended: stopping");
  stop();
}

void App::after_input(HostedCell& cell) {
  stage_ == Stage::kDraining ? ended() : monitor_port_.service().changed(cell);
}

/// Continues a shutdown after a line or a connection may have ended.
void App::ended() {
  if (stage_ == Stage::kDraining && has_no_clients()) io_.stop();
}

bool App::has_no_clients() const { return turns_.is_empty() && monitor_port_.is_empty(); }

std::size_t App::close_greediest() {
  if (const std::size_t trimmed = trim_frames()) return trimmed;
  const std::size_t of_lines = turns_.most_held();
  const std::size_t of_monitor = monitor_port_.most_held();
  if (of_lines == 0 && of_monitor == 0) return 0;
  of_lines > of_monitor ? turns_.close_greediest() : monitor_port_.close_greediest();
  return std::max(of_lines, of_monitor);
}

// Closes the ports, and lets lines and connections end by themselves until the deadline. ended()
// stops the event loop when the last of them has ended, even if other handlers still wait.
void App::stop() {
  if (stage_ == Stage::kDraining) return;
  stage_ = Stage::kDraining;
  service_manager_.stopping();
  port_file_.reset();
  const WallNs deadline = wall_now() + kDrainLimit;
  branch_cells_.stop();
  if (connection_cells_) connection_cells_->close();
  for (const CellPtr& each : cells_.all()) each->close(deadline - kDrainLimit / 2);
  turns_.close();
  monitor_port_.close(deadline);
  if (has_no_clients()) return io_.stop();
  run_at(drain_limit_, deadline, [this] {
    for (const CellPtr& each : cells_.all()) each->lines().abort();
    monitor_port_.abort();
    end_soon();
  });
}

// Aborts the sessions, which end by themselves when they are resumed. Requests may wait for the
// worker for long.
void App::end_soon() {
  run_after(drain_limit_, kAbortLimit, [this] { io_.stop(); });
}

}  // namespace xr3
