#include "server/cells/hosted_cell.hpp"

#include <utility>

namespace xr3 {

HostedCell::HostedCell(CellContext& context, CellParts parts)
    : context_(context),
      token_(std::move(parts.token)),
      events_(std::move(parts.sink)),
      cell_(std::move(parts.name), std::move(parts.model), parts.clock, context.rings),
      attention_(cell_),
      lines_(context.turns, cell_, [this] { after_input(); }),
      due_timer_(context.io, cell_, [this] { after_input(); }),
      silence_timer_(context.io, cell_, lines_, [this] { after_input(); }),
      hold_timer_(context.io, cell_, lines_),
      frames_(cell_),
      hub_(context.io, cell_, frames_, [this] { context_.turns.run_turns(); }),
      pictures_(context.io, context.worker) {
  cell_.observe(events_);
}

// The sessions give back their places at the port, which is destroyed before the sessions.
HostedCell::~HostedCell() {
  freeze();
  lines_.drop();
}

RobotPort& HostedCell::add_port(RobotPortRules rules) {
  assert(!port_);
  port_ = std::make_unique<RobotPort>(context_.io, cell_, lines_, std::move(rules));
  return *port_;
}

void HostedCell::serve_terminals(const std::vector<std::string>& paths, ::mode_t rights) {
  if (paths.empty()) return;
  ptys_ = std::make_unique<PtyPort>(context_.io, lines_);
  ptys_->serve(paths, rights);
}

void HostedCell::connect_device(const DeviceChoice& device, bool is_mirrored) {
  device_.emplace(context_.io, cell_, device.path, device.settings, is_mirrored,
                  [this] { after_input(); });
}

void HostedCell::record(std::string path, RecordingLimits limits) {
  recording_.emplace(context_.io, cell_, std::move(path), limits, [this] { after_input(); });
}

void HostedCell::record_daily(std::function<std::string()> new_path, RecordingLimits limits) {
  daily_files_.emplace(cell_, [this, new_path] {
    if (recording_) recording_->go_on_in(new_path);
  });
  record(new_path(), limits);
}

void HostedCell::finish_recording() {
  if (recording_) recording_->finish();
}

void HostedCell::leave(std::function<void()> wanted) {
  assert(port_ && !absence_);
  absence_.emplace(context_.io, std::move(wanted));
  port_->hold([this] { absence_->want(); });
}

asio::awaitable<void> HostedCell::be_back() {
  if (absence_) co_await absence_->wait();
}

void HostedCell::come_back() {
  assert(absence_);
  absence_->end();
  absence_.reset();
  port_->release();
  if (goals_) goals_->restart();
  after_input();
}

void HostedCell::describe(monitor::CellSummary& summary) const {
  attention_.describe(summary);
  if (goals_) goals_->describe(summary);
}

void HostedCell::after_input() {
  if (is_frozen_) return;
  if (goals_) goals_->update();
  for (const LineId line : cell_.take_woken_lines()) lines_.wake(line);
  due_timer_.update();
  silence_timer_.update();
  hold_timer_.update();
  if (device_) device_->pump();
  hub_.changed();
  context_.on_input(*this);
}

void HostedCell::close_ports() {
  if (port_) port_->close();
  if (ptys_) ptys_->close();
  due_timer_.close();
  silence_timer_.close();
  hold_timer_.close();
  if (device_) device_->close();
}

void HostedCell::close(WallNs deadline) {
  close_ports();
  lines_.close(deadline);
}

void HostedCell::retire() {
  assert(lines_.is_empty());
  is_retired_ = true;
  close_ports();
  freeze();
  lines_.close();
  hub_.stop();
}

void HostedCell::freeze() {
  is_frozen_ = true;
  cell_.freeze();
}

}  // namespace xr3
