#include "server/lines/sessions.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr const char* kLinesName = "the serial lines";

// The time after which other ports get a turn, and the time after which new bytes are looked for,
// which costs a microsecond.
constexpr WallNs kMaxTurnsTime = 500'000;
constexpr WallNs kNewsEvery = 30'000;
// The time of the turns between two handlers of other ports: a third of all time at most.
constexpr WallNs kMaxDueTime = 100'000;

/// While it exists, the timer is cancelled when bytes of the line have acted.
class Waiting {
 public:
  using Timers = std::multimap<LineId, asio::steady_timer*>;
  Waiting(Timers& all, LineId line, asio::steady_timer& timer)
      : all_(all), place_(all.emplace(line, &timer)) {}
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() { all_.erase(place_); }

 private:
  Timers& all_;
  Timers::iterator place_;
};

}  // namespace

LineSessions::LineSessions(asio::io_context& io, Cell& cell, std::function<void()> acted)
    : io_(io),
      cell_(cell),
      acted_(std::move(acted)),
      context_{cell, scratch_,
               [this](LineId line) {
                 if (line != kProbeLine) notify(line);
               },
               [this](LineId line, LineCloseReason reason) { end(line, reason); }},
      watch_(io) {}

std::optional<LineId> LineSessions::open(LineSource& source, std::unique_ptr<LineStream> stream,
                                         const LineOpened& opened,
                                         std::unique_ptr<PeerCounts::Place> place) {
  const auto session =
      std::make_shared<LineSession>(std::move(stream), opened, context_, source, std::move(place));
  const LineId line = session->line();
  sessions_.insert_or_assign(line, session);
  if (!watch_.add(session->descriptor(), line)) {
    session->close(LineCloseReason::kError);
    return std::nullopt;
  }
  if (!std::exchange(is_watching_, true)) spawn_loop(io_.get_executor(), kLinesName, run());
  if (line != kProbeLine) notify(line);
  return line;
}

void LineSessions::end(LineId line, LineCloseReason reason) {
  const auto session = sessions_.extract(line);
  if (is_closing_ && sessions_.empty()) watch_.close();
  if (session) session.mapped()->source().line_ended(line, reason);
  if (line != kProbeLine) return notify(line);
  if (is_closing_) acted_();
}

PortCounters LineSessions::counters() const {
  PortCounters all;
  for (const LineSource* source : sources_) {
    const PortCounters its = source->counters();
    all.refused += its.refused;
    all.accept_failures += its.accept_failures;
  }
  return all;
}

bool LineSessions::disconnect(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return false;
  const auto session = found->second;  // it removes itself from the map
  session->close(LineCloseReason::kDisconnected);
  return true;
}

// --- The limit of memory.

std::shared_ptr<LineSession> LineSessions::greediest() const {
  const auto holds_less = [](const auto& a, const auto& b) {
    return a.second->held_bytes() < b.second->held_bytes();
  };
  const auto most = std::max_element(sessions_.begin(), sessions_.end(), holds_less);
  return most == sessions_.end() ? nullptr : most->second;
}

std::size_t LineSessions::most_held() const {
  const auto session = greediest();
  return session ? session->held_bytes() : 0;
}

void LineSessions::close_greediest() { greediest()->close(LineCloseReason::kMemory); }

// --- Turns.

asio::awaitable<void> LineSessions::run() {
  for (bool has_news = true; has_news;) {
    has_news = co_await watch_.wait();
    if (has_news) run_turns();
  }
}

void LineSessions::run_due_turns() {
  if (!is_watching_ || wall_now() < next_turns_) return;
  vital(kLinesName, [this] {
    run_lightest(kMaxDueTime);
    if (!turns_.empty()) schedule_turns();
  });
}

// Light lines go first, and new ones are looked for again and again. One of the heaviest has a turn
// at the end, so that they are slow, but not forgotten. Then timers, signals and other ports get
// theirs.
void LineSessions::run_turns() {
  run_lightest(kMaxTurnsTime);
  if (turns_.empty()) return;
  run_turn(turns_.take_heaviest());
  schedule_turns();
}

void LineSessions::run_lightest(WallNs time) {
  const WallNs start = wall_now();
  take_news();
  for (WallNs now = start; !turns_.empty() && now < start + time; now = wall_now()) {
    while (!turns_.empty() && wall_now() < now + kNewsEvery) run_turn(turns_.take_lightest());
    take_news();
  }
  next_turns_ = wall_now() + kTurnsEvery;
}

// A line has its turn at once if no other one goes before it.
void LineSessions::take_news() {
  const WallNs end = wall_now() + kNewsEvery;
  for (const auto& [line, is_end, is_loss] : watch_.news()) {
    const auto found = sessions_.find(line);
    if (found == sessions_.end()) continue;
    if (is_end) found->second->note_end();
    if (is_loss) found->second->note_loss();
    const std::uint64_t load = found->second->load();
    const bool is_now = !turns_.contains(line) && turns_.is_next(load) && wall_now() < end;
    is_now ? run_turn(line) : turns_.add(line, load);
  }
}

void LineSessions::run_turn(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return;
  const auto session = found->second;  // it may remove itself from the map
  if (session->run_turn()) turns_.add(line, session->load());
}

void LineSessions::wake(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return;
  turns_.add(line, found->second->load());
  schedule_turns();
}

// The turns run after all handlers that are ready now.
void LineSessions::schedule_turns() {
  if (std::exchange(is_again_, true)) return;
  asio::post(io_, [this] {
    is_again_ = false;
    run_turns();
  });
}

void LineSessions::accept_arrived() {
  for (LineSource* source : sources_) source->accept_arrived();
}

void LineSessions::read_to_end(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return;
  const auto session = found->second;  // it may remove itself from the map
  if (session->read_arrived() && sessions_.contains(line)) turns_.add(line, session->load());
}

// sessions() copies the map: a session that ends removes itself from it.
void LineSessions::read_arrived() {
  vital(kLinesName, [this] {
    accept_arrived();
    for (const auto& [line, session] : sessions()) read_to_end(line);
    if (!turns_.empty()) schedule_turns();
  });
}

void LineSessions::read_arrived_on(LineId line) {
  vital(kLinesName, [&, this] {
    accept_arrived();
    read_to_end(line);
    if (!turns_.empty()) schedule_turns();
  });
}

asio::awaitable<bool> LineSessions::wait_for_bytes(LineId id, std::uint64_t bytes_in,
                                                   std::chrono::milliseconds within) {
  asio::steady_timer timer(io_, within);
  const auto deadline = timer.expiry();
  for (;;) {
    read_arrived_on(id);
    if (cell_.bytes_in(id).value_or(0) >= bytes_in) co_return true;
    const bool may_come = cell_.find_line(id) != nullptr && !is_closing_;
    if (!may_come || asio::steady_timer::clock_type::now() >= deadline) co_return false;
    const Waiting waiting(waiting_, id, timer);
    co_await timer.async_wait(kAwait);
  }
}

// Resumes the coroutines that wait for bytes of the line, which check again.
void LineSessions::notify(LineId line) {
  vital(kLinesName, [&, this] {
    const auto [begin, end] = waiting_.equal_range(line);
    for (auto each = begin; each != end; ++each) each->second->cancel();
    acted_();
  });
}

void LineSessions::close(WallNs deadline) {
  is_closing_ = true;
  for (const auto& [id, session] : sessions())
    wall_now() < deadline ? session->finish() : session->close(LineCloseReason::kShutdown);
  if (sessions_.empty()) watch_.close();
  for (const auto& [line, timer] : waiting_) timer->cancel();
  acted_();
}

void LineSessions::abort() {
  for (const auto& [id, session] : sessions()) session->close(LineCloseReason::kShutdown);
}

}  // namespace xr3
