// The cells of the process: those of the start, and those that come and go with connections.
#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <cassert>
#include <utility>

#include "server/app.hpp"
#include "server/log.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr double kNsPerSecond = 1e9;

SimClock start_clock(const ClockChoice& choice) {
  return choice.mode == ClockMode::kManual ? SimClock::manual()
                                           : SimClock::real(choice.rate, wall_now());
}

WallNs linger_of(const ServeOptions& options) {
  return static_cast<WallNs>(options.linger_s * kNsPerSecond);
}

/// The token of one cell; empty unless reading needs a token and there are several cells.
std::string cell_token(const ServeOptions& options) {
  return options.is_private && has_many_cells(options) ? read_token(FreshToken{}) : "";
}

}  // namespace

RobotPort& App::first_port() const { return *(probe_cell_ ? *probe_cell_ : first()).port(); }

CellPtr App::make_cell(const std::string& name, const CellSeed& seed, const std::string& token) {
  const std::string shown = has_many_cells(options_) ? name : "";
  const auto log = [shown](const CellEvent& event, const Model& model) {
    log_event(event, model, shown);
  };
  CellPtr cell =
      HostedCell::make(context_, {name, seed.model, start_clock(options_.clock), log, token});
  if (options_.line_speed) cell->cell().set_line_speed(*options_.line_speed);
  if (seed.faults) cell->cell().set_faults(*seed.faults);
  return cell;
}

void App::open_planned() {
  assert(seeds_.size() == plans_.size());
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const CellPtr cell = make_cell(plans_[i].name, seeds_[i], cell_token(options_));
    cell->add_port(port_rules());
    cells_.add(cell);
  }
}

// Each cell has an equal part of the lines, so that no client takes those of other cells.
RobotPortRules App::port_rules() const {
  const std::size_t lines =
      std::max<std::size_t>(1, limits_.lines / std::max<std::size_t>(1, plans_.size()));
  RobotPortRules rules{lines, options_.guard, peer_counts(lines, limits_.per_address)};
  if (options_.binds_peer) rules.owner_lingers = linger_of(options_);
  return rules;
}

// --- Cells of connections.

void App::serve_connections() {
  cells_.note_dynamic();
  ConnectionCellsRules rules{limits_.lines, options_.max_cells, linger_of(options_), options_.guard,
                             peer_counts(limits_.lines, limits_.per_address)};
  connection_cells_.emplace(
      io_, std::move(rules), [this](const std::string& name) { return open_for_connection(name); },
      [this](const CellPtr& cell) { close_cell(cell); });
  probe_cell_ = HostedCell::make(
      context_, {"probe", seeds_.front().model, start_clock(options_.clock), {}, {}});
  RobotPortRules port{1, options_.guard};
  port.divert = [this](tcp::socket socket) { connection_cells_->take(std::move(socket)); };
  probe_cell_->add_port(std::move(port));
}

CellPtr App::open_for_connection(const std::string& name) {
  CellPtr cell = make_cell(name, seeds_.front(), cell_token(options_));
  cells_.add(cell);
  cell->cell().report_opened();
  cell->acted();
  return cell;
}

// Handlers that wait in the event loop may refer to the cell, so it is released after them.
void App::close_cell(const CellPtr& cell) {
  cell->lines().abort();
  const std::map<LineId, SerialLine>& of_monitor = cell->cell().lines();
  while (!of_monitor.empty())
    cell->cell().apply(LineClosed{of_monitor.begin()->first, LineCloseReason::kDisconnected},
                       wall_now());
  cell->cell().report_closed();
  monitor_port_.service().forget(*cell);
  cells_.remove(*cell);
  cell->retire();
  asio::post(io_, [cell] {});
}

void App::count_more(CellCounters& counters) const {
  if (!connection_cells_) return;
  counters.robot_port.refused += connection_cells_->refused();
  counters.robot_port.accept_failures += probe_cell_->port_counters().accept_failures;
  counters.of(LineCloseReason::kNotARobotProgram) += connection_cells_->turned_away();
}

/// The frames of one cell are few; those of many together may be much.
std::size_t App::trim_frames() {
  std::size_t bytes = 0;
  if (!cells_.is_single())
    for (const CellPtr& each : cells_.all()) bytes += each->frames().trim();
  return bytes;
}

ServedPorts App::served_ports() const {
  ServedPorts ports{robot_endpoint().port(), monitor_endpoint().port(), fresh_token_, {}};
  for (const CellPlan& plan : plans_) {
    const CellPtr cell = cells_.find(plan.name);
    ports.cells.push_back({plan.name, cell->port()->endpoint().port(), cell->token()});
  }
  return ports;
}

}  // namespace xr3
