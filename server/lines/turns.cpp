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
constexpr WallNs kMaxTurnsTime = 500'000;
constexpr WallNs kNewsEvery = 30'000;
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
  for (const SessionNumber number : queue_.take_first_of_each()) run_turn(number);
  schedule();
}

void LineTurns::run_lightest(WallNs time) {
  const WallNs start = wall_now();
  take_news();
  for (WallNs now = start; !queue_.empty() && now < start + time; now = wall_now()) {
    while (!queue_.empty() && wall_now() < now + kNewsEvery) run_turn(queue_.take_lightest());
    take_news();
  }
  next_turns_ = wall_now() + kTurnsEvery;
}

// A line has its turn at once if no other one goes before it.
void LineTurns::take_news() {
  const WallNs end = wall_now() + kNewsEvery;
  for (const auto& [number, is_end, is_loss] : watch_.news()) {
    const auto found = sessions_.find(number);
    if (found == sessions_.end()) continue;
    if (is_end) found->second->note_end();
    if (is_loss) found->second->note_loss();
    const std::uint64_t load = found->second->load();
    const bool is_now = !queue_.contains(number) && queue_.is_next(load) && wall_now() < end;
    is_now ? run_turn(number) : queue_.add(number, load);
  }
}

void LineTurns::run_turn(SessionNumber number) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end()) return;
  const auto session = found->second;  // it may remove itself from the map
  if (session->run_turn()) queue_.add(number, session->load());
}

void LineTurns::wake(SessionNumber number) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end()) return;
  queue_.add(number, found->second->load());
  schedule();
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
