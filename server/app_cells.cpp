// The cells of the process: those of the start, and those of connections and branches.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cassert>
#include <utility>

#include "server/app.hpp"
#include "server/log.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr double kNsPerSecond = 1e9;

/// A new token of one cell; empty unless reading needs a token and there are several cells.
std::string fresh_cell_token(const ServeOptions& options) {
  return options.is_private && has_many_cells(options) ? read_token(FreshToken{}) : "";
}

call::Refused too_many_cells(std::size_t most) {
  return {"limit", "there are " + std::to_string(most) + " cells already",
          "raise --max-cells, or close a cell: a branch goes some time after its last line and "
          "subscriber (--linger)"};
}

call::Refused too_many_branches(const std::string& origin) {
  return {"limit",
          "cell " + origin + " has " + std::to_string(BranchCells::kMostPerOrigin) +
              " branches already",
          "close one: a branch closes some time after its last line and subscriber (--linger)"};
}

call::Refused too_few_descriptors(std::size_t most) {
  return {"limit", "the limit of open files allows only " + std::to_string(most) + " branches",
          "close one, or raise the limit with ulimit -n, or LimitNOFILE= of systemd"};
}

call::Refused is_stopping() {
  return {"stopping", "the server is stopping and opens no further cell",
          "connect again after its restart"};
}

}  // namespace

WallNs linger_of(const ServeOptions& options) {
  return static_cast<WallNs>(options.linger_s * kNsPerSecond);
}

tcp::endpoint App::robot_endpoint() const {
  return connection_cells_ ? connection_cells_->endpoint() : first().port()->endpoint();
}

// --- Readiness.

/// Returns a sentence with the reason why robot ports serve no clients; empty if they do.
std::string App::not_ready() const {
  if (stage_ != Stage::kReady) return "the server is starting or stopping";
  if (!turns_.is_watching()) return "the serial lines are not watched";
  std::string trouble = connection_cells_ ? connection_cells_->trouble() : "";
  bool is_full = !connection_cells_ || connection_cells_->is_full();
  for (const CellPlan& plan : plans_) {
    const RobotPort& port = *cells_.find(plan.name)->port();
    if (trouble.empty()) trouble = port.trouble();
    is_full = is_full && port.is_full();
  }
  if (!is_full || !trouble.empty()) return trouble;
  return "every line is in use: " + std::to_string(limits_.lines) + " are open (--max-lines)";
}

// --- Planned cells.

CellPtr App::make_cell(const std::string& name, const CellSeed& seed, std::string token) {
  const std::string shown = has_many_cells(options_) ? name : "";
  const auto log = [this, shown](const CellEvent& event, const Model& model) {
    if (!is_replaying_) log_event(event, model, {shown, page_});
  };
  return xr3::make_cell(context_, options_, seed, name, log, std::move(token));
}

void App::check_byte_clock() const {
  if (options_.clock.mode != ClockMode::kBytes) return;
  const ByteClock clock(byte_clock_settings(options_), options_.line_speed);
  const auto is_too_quick = [&clock](const CellSeed& seed) {
    return is_quicker_than_a_count(clock, *seed.model);
  };
  if (std::ranges::none_of(seeds_, is_too_quick)) return;
  spdlog::warn(
      "the byte clock lets less time pass for an inquiry than the slowest motor needs for a count: "
      "a program that compares two replies may take a moving joint for stuck; raise INQUIRY_MS of "
      "--clock bytes:INQUIRY_MS");
}

void App::open_planned() {
  assert(seeds_.size() == plans_.size() + (connection_cells_ ? 1 : 0));
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const CellPtr cell = make_cell(plans_[i].name, seeds_[i], plans_[i].token);
    cell->add_port(port_rules(lines_per_cell()));
    cells_.add(cell);
  }
}

// Each cell has an equal part of the lines, so that no client takes those of other cells. Beside
// cells of connections it has no more than it needs.
std::size_t App::lines_per_cell() const {
  const std::size_t shares = plans_.size() + (options_.is_cell_per_connection ? 1 : 0);
  const std::size_t equal = std::max<std::size_t>(1, limits_.lines / shares);
  return options_.is_cell_per_connection ? std::min(kLinesOfEachCell, equal) : equal;
}

std::size_t App::lines_of_connections() const {
  const std::size_t planned = plans_.size() * lines_per_cell();
  return std::max<std::size_t>(1, limits_.lines - std::min(limits_.lines, planned));
}

RobotPortRules App::port_rules(std::size_t lines) const {
  RobotPortRules rules{lines, options_.guard, peer_counts(limits_.per_address)};
  if (options_.binds_peer) rules.owner_lingers = linger_of(options_);
  return rules;
}

// --- Cells of connections.

void App::serve_connections() {
  cells_.note_dynamic();
  ConnectionCellsRules rules{lines_of_connections(), options_.max_cells - plans_.size(),
                             linger_of(options_), options_.guard, peer_counts(limits_.per_address)};
  rules.report_other = [this] {
    spdlog::info("a client of the robot port is no robot program, and gets no cell; {}",
                 browser_hint(page_));
  };
  rules.cell_of = [this](const asio::ip::address& machine) {
    const auto name = student_machines_.cell_on(machine);
    return name ? cells_.find(*name) : nullptr;
  };
  monitor_port_.service().sessions().when_opened(
      [this](const asio::ip::address& machine, const HostedCell& cell) {
        if (cell.port() != nullptr && cell.port()->is_shared())
          student_machines_.note(machine, cell.name());
      });
  connection_cells_.emplace(
      io_, std::move(rules), [this](const std::string& name) { return open_for_connection(name); },
      [this](const CellPtr& cell) { close_cell(cell); });
}

CellPtr App::open_for_connection(const std::string& name) {
  CellPtr cell = make_cell(name, seeds_.back(), fresh_cell_token(options_));
  cells_.add(cell);
  record_or_report(*cell);
  keep_history(*cell);
  cell->cell().report_opened();
  cell->after_input();
  return cell;
}

// --- Branches.

std::variant<CellPtr, call::Refused> App::open_branch(HostedCell& of, MachineSnapshotPtr past) {
  if (stage_ != Stage::kReady) return is_stopping();
  const std::string origin = branch_cells_.origin_of(of);
  if (branch_cells_.count(origin) >= BranchCells::kMostPerOrigin) return too_many_branches(origin);
  if (cells_.size() >= options_.max_cells) return too_many_cells(cells_.size());
  if (branch_cells_.size() >= limits_.branches) return too_few_descriptors(limits_.branches);
  std::string name = branch_cells_.next_name(origin);
  while (cells_.find(name)) name = branch_cells_.next_name(origin);
  const CellPtr cell = make_branch(name, of, *past);
  try {
    listen_on_cell(*cell, 0);
  } catch (const ExitError& error) {
    cell->retire();
    asio::post(io_, [cell] {});
    return call::Refused{"limit", error.what(), "close another cell or connection"};
  }
  begin_branch(*cell, std::move(past));
  cells_.note_dynamic();
  cells_.add(cell);
  branch_cells_.add(cell, origin);
  cell->cell().report_opened();
  cell->after_input();
  return cell;
}

CellPtr App::make_branch(const std::string& name, HostedCell& of, const MachineSnapshot& past) {
  const FaultPlan& faults = of.cell().value().initial_faults;
  const CellSeed seed{past.model, faults.faults.empty() ? std::nullopt : std::optional(faults)};
  CellPtr cell = make_cell(name, seed, fresh_cell_token(options_));
  cell->add_port(port_rules(std::min(kLinesPerBranch, lines_per_cell())));
  return cell;
}

// Begins a branch, which runs at once. Its recording, if any, begins with the state from the past.
void App::begin_branch(HostedCell& cell, MachineSnapshotPtr past) {
  if (has_many_cells(options_)) record_or_report(cell);
  keep_history(cell);
  cell.cell().apply(Rewind{std::move(past), {}}, wall_now());
  cell.cell().apply(Input{call::Call{call::Resume{}}}, wall_now());
}

// Handlers that wait in the event loop may refer to the cell, so it is released after them.
void App::close_cell(const CellPtr& cell) {
  cell->lines().abort();
  const std::map<LineId, SerialLine>& of_monitor = cell->cell().lines();
  while (!of_monitor.empty())
    cell->cell().apply(LineClosed{of_monitor.begin()->first, LineCloseReason::kDisconnected},
                       wall_now());
  cell->cell().report_closed();
  cell->finish_recording();
  monitor_port_.service().remove_cell(*cell);
  branch_cells_.release_name(*cell);
  cells_.remove(*cell);
  cell->retire();
  asio::post(io_, [cell] {});
}

void App::count_more(CellCounters& counters) {
  counters.lines_max = limits_.lines;
  counters.allocated_bytes = allocated_bytes();
  counters.allocated_max = memory_.max_bytes();
  if (!options_.record.empty())
    counters.recording_room = record_room_.left(options_.record, wall_now());
  if (!connection_cells_) return;
  counters.robot_port.refused += connection_cells_->refused();
  counters.robot_port.accept_failures += connection_cells_->accept_failures();
  counters.of(LineCloseReason::kNotARobotProgram) += connection_cells_->turned_away();
}

/// Frees frames. The frames of one cell are few; those of many together may be much.
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
