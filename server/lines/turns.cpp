#include "server/lines/turns.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cassert>
#include <utility>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr const char* kTurnsName = "the serial lines";

// The time after which other ports have their turn.
constexpr WallNs kMaxTurnsTime = 250'000;
// The time of the turns between two handlers of other ports: a third of all time at most.
constexpr WallNs kMaxDueTime = 100'000;

}  // namespace

std::optional<SessionNumber> LineTurns::add(std::shared_ptr<LineSession> session) {
  while (sessions_.contains(++last_)) {
  }
  if (!watch_.add(session->descriptor(), last_)) return std::nullopt;
  sessions_.emplace(last_, TurnEntry{std::move(session)});
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
      sessions_, {}, [](const auto& each) { return each.second.session->held_bytes(); });
  return most == sessions_.end() ? nullptr : most->second.session;
}

std::size_t LineTurns::most_held() const {
  const auto session = greediest();
  return session ? session->held_bytes() : 0;
}

void LineTurns::close_greediest() { greediest()->close(LineCloseReason::kMemory); }

// --- Turns.

// (g++ 12 generates wrong code for co_await in the condition of a loop.)
asio::awaitable<void> LineTurns::run() {
  for (bool has_news = true; has_news;) {
    has_news = co_await watch_.wait();
    if (has_news) run_turns();
  }
}

void LineTurns::run_due_turns() {
  if (!is_watching_ || wall_now() < next_turns_) return;
  vital(kTurnsName, [this] { run_for(kMaxDueTime); });
}

void LineTurns::run_turns() { run_for(kMaxTurnsTime); }

// Looks again at once if several lines had turns: others have probably asked meanwhile, and to wait
// for the event loop costs more.
void LineTurns::run_for(WallNs time) {
  WallNs now = wall_now();
  const WallNs end = now + time;
  int turns = 0;
  do {
    queue_news();
    for (turns = 0; has_waiting() && now < end; ++turns, now = wall_now())
      run_turn(take_first(next_queue()));
  } while (turns > 1 && now < end);
  next_turns_ = now + kTurnsEvery;
  if (has_waiting()) schedule();
}

void LineTurns::run_news() {
  queue_news();
  for (std::size_t left = ready_.size(); left > 0 && !ready_.empty(); --left)
    run_turn(take_first(ready_));
}

void LineTurns::queue_news() {
  for (const auto& [number, is_end, is_loss] : watch_.news()) {
    const auto found = sessions_.find(number);
    if (found == sessions_.end()) continue;
    if (is_end) found->second.session->note_end();
    if (is_loss) found->second.session->note_loss();
    add_to(ready_, number);
  }
}

void LineTurns::add_to(Queue& queue, SessionNumber number) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end() || std::exchange(found->second.is_queued, true)) return;
  queue.push_back(number);
}

/// Alternates between the two queues, unless one is empty.
LineTurns::Queue& LineTurns::next_queue() {
  const bool is_busy = ready_.empty() || (is_busy_next_ && !busy_.empty());
  is_busy_next_ = !is_busy;
  return is_busy ? busy_ : ready_;
}

SessionNumber LineTurns::take_first(Queue& queue) {
  assert(!queue.empty());
  const SessionNumber first = queue.front();
  queue.pop_front();
  const auto found = sessions_.find(first);
  if (found != sessions_.end()) found->second.is_queued = false;
  return first;
}

LineSession::Turn LineTurns::run_turn(SessionNumber number) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end()) return LineSession::Turn::kBlocked;
  const std::shared_ptr<LineSession> session = found->second.session;  // it may remove itself
  const LineSession::Turn turn = session->run_turn(wall_now());
  if (turn == LineSession::Turn::kMore) add_to(busy_, number);
  return turn;
}

void LineTurns::wake(SessionNumber number) {
  add_to(ready_, number);
  schedule();
}

asio::awaitable<void> LineTurns::pause() {
  co_await pausing_.until_free();
  const Exclusive::Hold hold(pausing_);
  co_await asio::post(io_, kAwait);
}

// The turns run after all handlers that are ready now.
void LineTurns::schedule() {
  if (std::exchange(is_scheduled_, true)) return;
  asio::post(io_, [this] {
    is_scheduled_ = false;
    run_turns();
  });
}

}  // namespace xr3
