#include "server/lines/turns.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr const char* kTurnsName = "the serial lines";

// The time after which other ports get a turn, and the time after which new bytes are looked for,
// which costs a microsecond.
constexpr WallNs kMaxTurnsTime = 250'000;
constexpr WallNs kNewsEvery = LineTurns::kTurnsEvery;
// The time of the turns between two handlers of other ports: a third of all time at most.
constexpr WallNs kMaxDueTime = 100'000;

}  // namespace

std::optional<SessionNumber> LineTurns::add(std::shared_ptr<LineSession> session) {
  while (sessions_.contains(++last_)) {
  }
  if (!watch_.add(session->descriptor(), last_)) return std::nullopt;
  sessions_.emplace(last_, std::move(session));
  if (!std::exchange(is_watching_, true)) spawn_loop(io_.get_executor(), kTurnsName, run());
  return last_;
}

void LineTurns::remove(SessionNumber number) {
  sessions_.erase(number);
  if (is_closing_ && sessions_.empty()) watch_.close();
}

void LineTurns::close() {
  is_closing_ = true;
  if (sessions_.empty()) watch_.close();
}

// --- The limit of memory.

std::shared_ptr<LineSession> LineTurns::greediest() const {
  const auto most = std::ranges::max_element(
      sessions_, {}, [](const auto& each) { return each.second->held_bytes(); });
  return most == sessions_.end() ? nullptr : most->second;
}

std::size_t LineTurns::most_held() const {
  const auto session = greediest();
  return session ? session->held_bytes() : 0;
}

void LineTurns::close_greediest() { greediest()->close(LineCloseReason::kMemory); }

// --- Turns.

asio::awaitable<void> LineTurns::run() {
  for (bool has_news = true; has_news;) {
    has_news = co_await watch_.wait();
    if (has_news) run_turns();
  }
}

void LineTurns::run_due_turns() {
  if (!is_watching_ || wall_now() < next_turns_) return;
  vital(kTurnsName, [this] {
    run_lightest(kMaxDueTime);
    if (!queue_.empty()) schedule();
  });
}

// Light lines go first, and new ones are looked for again and again. One of each load has a turn at
// the end, so that heavy and new lines are slow, but not forgotten. Then timers, signals and other
// ports get theirs.
void LineTurns::run_turns() {
  run_lightest(kMaxTurnsTime);
  if (queue_.empty()) return;
  for (const SessionNumber number : queue_.take_first_of_each()) run_turn(number, wall_now());
  schedule();
}

// Looks again at once if several lines had news: others have probably asked meanwhile, and to wait
// for the event loop costs more.
void LineTurns::run_lightest(WallNs time) {
  WallNs now = wall_now();
  const WallNs end = now + time;
  std::size_t lines = run_news(now, end);
  while (now < end && (lines > 1 || !queue_.empty())) {
    const WallNs look = std::min(now + kNewsEvery, end);
    for (; !queue_.empty() && now < look; now = wall_now()) run_turn(queue_.take_lightest(), now);
    lines = run_news(now, end);
  }
  next_turns_ = now + kTurnsEvery;
}

// Runs the turns of lines with news until `end`, and queues those that have to wait: a line has its
// turn at once if no other one goes before it. `now` is the time before, then the time after them.
// Returns the number of lines with news.
std::size_t LineTurns::run_news(WallNs& now, WallNs end) {
  const std::span<const LineWatch::News> news = watch_.news();
  end = std::min(end, now + kNewsEvery);
  for (const auto& [number, is_end, is_loss] : news) {
    const auto found = sessions_.find(number);
    if (found == sessions_.end()) continue;
    if (is_end) found->second->note_end();
    if (is_loss) found->second->note_loss();
    const std::uint64_t load = found->second->load(now);
    if (queue_.contains(number) || !queue_.is_next(load) || now >= end) {
      queue_.add(number, load, found->second->peer());
    } else {
      run_turn(number, found->second, now);
      now = wall_now();
    }
  }
  return news.size();
}

void LineTurns::take_news() {
  WallNs now = wall_now();
  run_news(now, kNever);
  if (!queue_.empty()) schedule();
}

void LineTurns::run_turn(SessionNumber number, WallNs now) {
  const auto found = sessions_.find(number);
  if (found != sessions_.end()) run_turn(number, found->second, now);
}

// The pointer is a copy, since the session may remove itself from the map.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void LineTurns::run_turn(SessionNumber number, std::shared_ptr<LineSession> session, WallNs now) {
  if (session->run_turn(now)) queue_.add(number, session->load(wall_now()), session->peer());
}

void LineTurns::wake(SessionNumber number) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end()) return;
  queue_.add(number, found->second->load(wall_now()), found->second->peer());
  schedule();
}

asio::awaitable<void> LineTurns::pause() {
  co_await pausing_.until_free();
  const Exclusive::Hold hold(pausing_);
  co_await asio::post(io_, kAwait);
}

// The turns run after all handlers that are ready now.
void LineTurns::schedule() {
  if (std::exchange(is_again_, true)) return;
  asio::post(io_, [this] {
    is_again_ = false;
    run_turns();
  });
}

}  // namespace xr3
