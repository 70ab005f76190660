#include "cli/exec/robot_host.hpp"

#include <system_error>
#include <utility>

#include "server/log.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"
#include "server/options/token.hpp"

namespace xr3 {
namespace {

constexpr std::uint32_t kOwnerOnly = 0600;

tcp::endpoint any_port() { return {asio::ip::address_v4::loopback(), 0}; }

void require_port(ErrorCode error, const char* what) {
  if (error) throw std::system_error(error, std::string("cannot listen for the ") + what);
}

/// The access rules. Unless the program may control the cell, calls need a random token that is
/// stored nowhere.
AccessRules rules_of(MonitorAccess access) {
  const bool is_read_only = access == MonitorAccess::kRead;
  return {{http::HostReach::kThisMachine, {}, {}},
          ReadAccess::kFree,
          is_read_only ? read_token(FreshToken{}) : ""};
}

}  // namespace

RobotHost::RobotHost(const ServeOptions& options, const CellSeed& seed, MonitorAccess access,
                     const std::string& pty, int listener)
    : context_{io_, turns_, worker_,
               [this](HostedCell& cell) {
                 if (monitor_) monitor_->service().changed(cell);
                 if (on_input_) on_input_();
               }},
      cell_(make_cell(context_, options, seed, "main",
                      [](const CellEvent& event, const Model& model) { log_event(event, model); })),
      policy_(rules_of(access)) {
  cell_->add_port({options.max_lines, options.guard});
  cells_.add(cell_);
  RobotPort& port = *cell_->port();
  require_port(listener < 0 ? port.listen(any_port()) : port.adopt(listener), "robot");
  cell_->serve_terminals({pty}, kOwnerOnly);
  if (!options.record.empty())
    cell_->record(options.record, {std::uint64_t{options.record_max_mib} << 20U});
  if (access == MonitorAccess::kNone) return;
  monitor_.emplace(
      io_, cells_, worker_, policy_, [] { return std::string(); }, [] {}, SocketLimits());
  require_port(monitor_->listen(any_port()), "monitor");
}

RobotHost::~RobotHost() {
  cell_->freeze();
  worker_.stop();
  io_.shutdown();
  cell_->lines().drop();
}

std::optional<std::uint16_t> RobotHost::monitor_port() const {
  return monitor_ ? std::optional(monitor_->endpoint().port()) : std::nullopt;
}

void RobotHost::run(const std::function<bool()>& is_over) {
  while (!is_over() && io_.run_one() > 0) turns_.run_due_turns();
}

void RobotHost::close_ports() {
  spawn_session(io_.get_executor(), "the serial lines", cell_->lines().read_arrived(),
                [this] { has_read_arrived_ = true; });
  run([this] { return has_read_arrived_; });
  cell_->port()->close();
}

bool RobotHost::are_lines_closed() {
  turns_.run_events();
  return turns_.is_empty();
}

void RobotHost::abort_lines() { cell_->lines().abort(LineCloseReason::kDisconnected); }

void RobotHost::come_to_rest(Tick limit) {
  cell().apply(Input{call::Call{call::Pause{}}}, wall_now());
  cell().apply(Input{call::Call{call::RunUntil{std::nullopt, limit}}}, wall_now());
}

}  // namespace xr3
