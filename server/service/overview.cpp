#include "server/service/overview.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <nlohmann/json.hpp>

#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr WallNs kPeriod = 1'000'000'000 / Overview::kPerSecond;
// The rounds take one part of so many.
constexpr WallNs kRestFactor = 10;
// The time after which the event loop has its turn.
constexpr WallNs kSlice = 300'000;
constexpr std::size_t kMaxClosed = 1024;

}  // namespace

monitor::CellSummary summary_of(HostedCell& at) {
  Cell& cell = at.cell();
  cell.catch_up(wall_now());
  monitor::CellSummary summary = monitor::machine_summary(cell.model(), cell.state());
  summary.name = cell.name();
  if (const RobotPort* port = at.port()) {
    summary.robot_port = port->endpoint().port();
    if (port->owner()) summary.owner = port->owner()->to_string();
  }
  summary.lines = cell.lines().size();
  if (!cell.lines().empty()) summary.peer = cell.lines().rbegin()->second.peer();
  summary.has_recording_failed = cell.counters().recordings_failed > 0;
  summary.last_input_tick = cell.value().last_input_tick;
  summary.epoch = cell.epoch();
  summary.is_paused = cell.clock().mode() != cell.clock().running_mode();
  summary.is_frozen = cell.is_frozen();
  summary.is_coming_back = at.is_absent();
  summary.viewers = at.hub().sessions().size();
  at.describe(summary);
  return summary;
}

Overview::Overview(asio::io_context& io, CellRegistry& cells, std::function<void()> run_lines)
    : io_(io), cells_(cells), run_lines_(std::move(run_lines)), timer_(io) {}

void Overview::add(MonitorSession& session) {
  if (std::ranges::find(sessions_, &session) == sessions_.end()) sessions_.push_back(&session);
  begin();
}

// Without subscribers nothing is remembered.
void Overview::remove(MonitorSession& session) {
  const auto found = std::ranges::find(sessions_, &session);
  if (found == sessions_.end()) return;
  if (static_cast<std::size_t>(found - sessions_.begin()) < next_) --next_;
  sessions_.erase(found);
  if (!sessions_.empty()) return;
  changed_.clear();
  shown_.clear();
  by_version_.clear();
  dropped_version_ = version_;
  closed_.clear();
  timer_.cancel();
}

void Overview::restart(MonitorSession& session) {
  if (session.client().overview() == nullptr) return;
  session.client().overview()->restart();
  begin();
}

void Overview::changed(HostedCell& cell) {
  if (sessions_.empty() || cell.is_retired()) return;
  const bool was_quiet = changed_.empty() && !is_behind_;
  changed_.insert(&cell);
  if (was_quiet) timer_.cancel();
}

void Overview::remove_cell(const HostedCell& cell) {
  auto* const key = const_cast<HostedCell*>(&cell);
  changed_.erase(key);
  now_.erase(key);
  const auto shown = shown_.find(key);
  if (shown == shown_.end()) return;
  by_version_.erase(shown->second.version);
  shown_.erase(shown);
  closed_.emplace_back(++version_, cell.name());
  if (closed_.size() > kMaxClosed) {
    dropped_version_ = closed_.front().first;
    closed_.pop_front();
  }
  if (!is_behind_) timer_.cancel();
  is_behind_ = true;
}

void Overview::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

// --- Rounds.

void Overview::begin() {
  is_behind_ = true;
  if (is_stopped_) return;
  if (shown_.empty())
    for (const CellPtr& each : cells_.all()) changed_.insert(each.get());
  timer_.cancel();
  if (!std::exchange(is_running_, true)) spawn_loop(io_.get_executor(), "the overview", run());
}

asio::awaitable<void> Overview::run() {
  WallNs earliest = 0;  // time of the next round
  while (!is_stopped_ && !sessions_.empty()) {
    const bool is_quiet = changed_.empty() && !is_behind_;
    if (is_quiet || wall_now() < earliest) {
      timer_.expires_at(is_quiet ? asio::steady_timer::time_point::max() : as_time_point(earliest));
      co_await timer_.async_wait(kAwait);
      continue;
    }
    const WallNs start = wall_now();
    co_await examine_cells();
    co_await serve_sessions();
    made_.clear();
    earliest = std::max(start + kPeriod, wall_now() + kRestFactor * (wall_now() - start));
  }
  is_running_ = false;
}

/// Lets the lines and other handlers have their turn.
asio::awaitable<void> Overview::pause_if_long(WallNs& since) {
  if (wall_now() < since + kSlice) co_return;
  run_lines_();
  co_await asio::post(io_, asio::use_awaitable);
  since = wall_now();
}

asio::awaitable<void> Overview::examine_cells() {
  now_ = std::exchange(changed_, {});
  WallNs since = wall_now();
  while (!now_.empty() && !is_stopped_) {
    HostedCell& cell = **now_.begin();
    now_.erase(now_.begin());
    examine(cell);
    co_await pause_if_long(since);
  }
}

void Overview::examine(HostedCell& cell) {
  if (sessions_.empty()) return;
  const monitor::CellSummary summary = summary_of(cell);
  if (cell.cell().has_news_to_come()) changed_.insert(&cell);
  Shown& shown = shown_[&cell];
  if (shown.version > 0 && !monitor::is_news(shown.summary, summary)) return;
  by_version_.erase(shown.version);
  shown = {summary, monitor::text_of(monitor::summary_json(summary)), ++version_};
  by_version_.emplace(shown.version, &cell);
}

asio::awaitable<void> Overview::serve_sessions() {
  is_behind_ = false;
  WallNs since = wall_now();
  for (next_ = 0; next_ < sessions_.size() && !is_stopped_;) {
    serve(*sessions_[next_++]);
    co_await pause_if_long(since);
  }
}

void Overview::serve(MonitorSession& session) {
  monitor::OverviewSubscription* const wanted = session.client().overview();
  if (wanted == nullptr || wanted->seen() >= version_) return;
  const monitor::FrameNumber now = SubscriberHub::wall_frame();
  if (wanted->is_waiting() || !wanted->is_due(now)) {
    is_behind_ = true;
    return;
  }
  wanted->offer(message_for(session, wanted->seen()), version_, now);
  session.wake();
}

// --- Messages.

monitor::Message Overview::message_for(const MonitorSession& session, std::int64_t since) {
  if (session.access() == Access::kNone) return make(since, &session);
  monitor::Message& shared = made_[since];
  if (!shared) shared = make(since, nullptr);
  return shared;
}

/// The changes after a version. `only_granted_of`: a session to whose granted cells they are
/// limited; nullptr if they are not limited.
monitor::Message Overview::make(std::int64_t since, const MonitorSession* only_granted_of) const {
  const bool is_whole = since == 0 || since < dropped_version_;
  const auto is_visible = [&](const std::string& name) {
    return only_granted_of == nullptr || only_granted_of->is_granted(name);
  };
  std::vector<std::string> cells;
  for (auto each = by_version_.upper_bound(is_whole ? 0 : since); each != by_version_.end(); ++each)
    if (is_visible(each->second->name())) cells.push_back(shown_.at(each->second).text);
  std::vector<std::string> closed;
  for (const auto& [version, name] : closed_)
    if (!is_whole && version > since && is_visible(name)) closed.push_back(name);
  return monitor::overview_message(version_, unix_ms(), is_whole, cells, closed);
}

monitor::Message Overview::whole(const MonitorSession& session,
                                 const std::vector<monitor::CellSummary>& cells) const {
  std::vector<std::string> texts;
  for (const monitor::CellSummary& each : cells) {
    if (session.access() == Access::kNone && !session.is_granted(each.name)) continue;
    texts.push_back(monitor::text_of(monitor::summary_json(each)));
  }
  return monitor::overview_message(version_, unix_ms(), true, texts, {});
}

asio::awaitable<std::vector<monitor::CellSummary>> Overview::summaries() {
  std::vector<CellPtr> all = cells_.all();
  std::vector<monitor::CellSummary> summaries;
  WallNs since = wall_now();
  for (const CellPtr& each : all) {
    if (!each->is_retired()) summaries.push_back(summary_of(*each));
    co_await pause_if_long(since);
  }
  co_return summaries;
}

}  // namespace xr3
