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

void LineTurns::close_greediest() {
  assert(most_held() > 0);
  greediest()->close(LineCloseReason::kMemory);
}

// --- Turns.

// (g++ 12 generates wrong code for co_await in the condition of a loop.)
asio::awaitable<void> LineTurns::run() {
  for (bool is_open = true; is_open;) {
    is_open = co_await watch_.wait();
    if (is_open) run_turns();
  }
}

void LineTurns::run_due_turns() {
  if (!is_watching_ || wall_now() < next_turns_) return;
  fatal_if_throws(kTurnsName, [this] { run_for(kMaxDueTime); });
}

void LineTurns::run_turns() { run_for(kMaxTurnsTime); }

// Polls again at once if several lines had turns: other bytes have probably arrived meanwhile, and
// to wait for the event loop costs more.
void LineTurns::run_for(WallNs time) {
  WallNs now = wall_now();
  const WallNs end = now + time;
  int turns = 0;
  do {
    queue_events();
    for (turns = 0; has_waiting() && now < end; ++turns, now = wall_now())
      run_turn(pop_front(next_queue()));
  } while (turns > 1 && now < end);
  next_turns_ = now + kTurnsEvery;
  if (has_waiting()) schedule();
}

void LineTurns::run_events() {
  queue_events();
  for (std::size_t left = ready_.size(); left > 0 && !ready_.empty(); --left)
    run_turn(pop_front(ready_));
}

void LineTurns::queue_events() {
  for (const auto& [number, is_end, is_loss] : watch_.poll()) {
    const auto found = sessions_.find(number);
    if (found == sessions_.end()) continue;
    if (is_end) found->second.session->set_ending();
    if (is_loss) found->second.session->set_broken();
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

SessionNumber LineTurns::pop_front(Queue& queue) {
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
  const auto session = found->second.session;  // kept, since it may remove itself
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
