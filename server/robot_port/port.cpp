#include "server/robot_port/port.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr const char* kName = "the robot port";

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

RobotPort::RobotPort(asio::io_context& io, Cell& cell, RobotPortRules rules,
                     std::function<void()> acted)
    : io_(io),
      cell_(cell),
      rules_(std::move(rules)),
      acted_(std::move(acted)),
      context_{cell,
               false,
               rules_.guard,
               scratch_,
               [this](LineId line) { notify(line); },
               [this](LineId line) { end(line); }},
      probe_context_{cell,
                     true,
                     rules_.guard,
                     scratch_,
                     [this](LineId) {
                       probe_progress_ =
                           cell_.state().enabled ? ProbeProgress::kTaken : ProbeProgress::kIgnored;
                     },
                     [this](LineId) { end_probe(); }},
      listener_(io, kName, [this](tcp::socket socket) { open(std::move(socket)); }),
      watch_(io) {}

ErrorCode RobotPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void RobotPort::open(tcp::socket socket) {
  const bool is_probe = this->is_probe(socket);
  if (is_full()) take_news();              // a client may have closed its line without our notice
  if (is_full()) return refuse(is_probe);  // closed without a byte
  const asio::ip::address peer = peer_address(socket);
  auto place = rules_.peers.take(peer);
  if (!place && !is_probe) return refuse_peer(peer);
  auto& context = is_probe ? probe_context_ : context_;
  const auto session = std::make_shared<RobotSession>(std::move(socket), context, std::move(place));
  sessions_.insert_or_assign(session->line(), session);
  if (!watch_.add(session->descriptor(), session->line()))
    return session->close(LineCloseReason::kError);
  if (!std::exchange(is_watching_, true)) spawn_loop(io_.get_executor(), kName, run());
  if (!is_probe) notify(session->line());
}

bool RobotPort::is_full() const {
  return sessions_.size() - sessions_.count(kProbeLine) >= rules_.max_lines;
}

void RobotPort::refuse(bool is_probe) {
  if (is_probe) {
    probe_progress_ = ProbeProgress::kRefused;
    return;
  }
  ++refused_;
  if (std::exchange(has_logged_full_, true)) return;
  spdlog::warn("lines are refused: {} are open already (--max-lines; reported once until one ends)",
               rules_.max_lines);
}

void RobotPort::refuse_peer(const asio::ip::address& peer) {
  ++refused_;
  if (std::exchange(has_logged_peer_, true)) return;
  spdlog::warn(
      "lines of {} are refused: it has as many open as one address may have (--max-per-address; "
      "reported once until one ends)",
      peer.to_string());
}

void RobotPort::end(LineId line) {
  sessions_.erase(line);
  has_logged_full_ = has_logged_peer_ = false;
  if (is_closing_ && sessions_.empty()) watch_.close();
  notify(line);
}

bool RobotPort::disconnect(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return false;
  const auto session = found->second;  // it removes itself from the map
  session->close(LineCloseReason::kDisconnected);
  return true;
}

// --- The limit of memory.

std::shared_ptr<RobotSession> RobotPort::greediest() const {
  const auto holds_less = [](const auto& a, const auto& b) {
    return a.second->held_bytes() < b.second->held_bytes();
  };
  const auto most = std::max_element(sessions_.begin(), sessions_.end(), holds_less);
  return most == sessions_.end() ? nullptr : most->second;
}

std::size_t RobotPort::most_held() const {
  const auto session = greediest();
  return session ? session->held_bytes() : 0;
}

void RobotPort::close_greediest() { greediest()->close(LineCloseReason::kMemory); }

// --- The probe.

void RobotPort::expect_probe(const tcp::endpoint& from) {
  probe_from_ = from;
  probe_progress_ = ProbeProgress::kUnseen;
}

bool RobotPort::is_probe(const tcp::socket& socket) {
  if (!probe_from_) return false;
  ErrorCode error;
  if (socket.remote_endpoint(error) != *probe_from_ || error) return false;
  probe_from_.reset();
  probe_progress_ = ProbeProgress::kAccepted;
  return true;
}

void RobotPort::end_probe() {
  sessions_.erase(kProbeLine);
  if (!is_closing_) return;
  if (sessions_.empty()) watch_.close();
  acted_();
}

// --- Turns.

asio::awaitable<void> RobotPort::run() {
  for (bool has_news = true; has_news;) {
    has_news = co_await watch_.wait();
    if (has_news) run_turns();
  }
}

void RobotPort::run_due_turns() {
  if (!is_watching_ || wall_now() < next_turns_) return;
  vital(kName, [this] {
    run_lightest(kMaxDueTime);
    if (!turns_.empty()) schedule_turns();
  });
}

// Light lines go first, and new ones are looked for again and again. One of the heaviest has a turn
// at the end, so that they are slow, but not forgotten. Then timers, signals and other ports get
// theirs.
void RobotPort::run_turns() {
  run_lightest(kMaxTurnsTime);
  if (turns_.empty()) return;
  run_turn(turns_.take_heaviest());
  schedule_turns();
}

void RobotPort::run_lightest(WallNs time) {
  const WallNs start = wall_now();
  take_news();
  for (WallNs now = start; !turns_.empty() && now < start + time; now = wall_now()) {
    while (!turns_.empty() && wall_now() < now + kNewsEvery) run_turn(turns_.take_lightest());
    take_news();
  }
  next_turns_ = wall_now() + kTurnsEvery;
}

// A line has its turn at once if no other one goes before it.
void RobotPort::take_news() {
  const WallNs end = wall_now() + kNewsEvery;
  for (const auto& [line, is_end] : watch_.news()) {
    const auto found = sessions_.find(line);
    if (found == sessions_.end()) continue;
    if (is_end) found->second->note_end();
    const std::uint64_t load = found->second->load();
    const bool is_now = !turns_.contains(line) && turns_.is_next(load) && wall_now() < end;
    is_now ? run_turn(line) : turns_.add(line, load);
  }
}

void RobotPort::run_turn(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return;
  const auto session = found->second;  // it may remove itself from the map
  if (session->run_turn()) turns_.add(line, session->load());
}

// The turns run after all handlers that are ready now.
void RobotPort::schedule_turns() {
  if (std::exchange(is_again_, true)) return;
  asio::post(io_, [this] {
    is_again_ = false;
    run_turns();
  });
}

// sessions() copies the map: a session that ends removes itself from it.
void RobotPort::read_arrived() {
  vital(kName, [this] {
    listener_.accept_pending();
    for (const auto& [id, session] : sessions()) {
      if (session->read_arrived() && sessions_.contains(id)) turns_.add(id, session->load());
    }
    if (!turns_.empty()) schedule_turns();
  });
}

void RobotPort::read_arrived_on(LineId line) {
  vital(kName, [&, this] {
    listener_.accept_pending();
    const auto found = sessions_.find(line);
    if (found == sessions_.end()) return;
    const auto session = found->second;  // it may remove itself from the map
    if (session->read_arrived() && sessions_.contains(line)) turns_.add(line, session->load());
    if (!turns_.empty()) schedule_turns();
  });
}

asio::awaitable<bool> RobotPort::wait_for_bytes(LineId id, std::uint64_t bytes_in,
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
void RobotPort::notify(LineId line) {
  vital(kName, [&, this] {
    const auto [begin, end] = waiting_.equal_range(line);
    for (auto each = begin; each != end; ++each) each->second->cancel();
    acted_();
  });
}

void RobotPort::close(WallNs deadline) {
  is_closing_ = true;
  listener_.close();
  for (const auto& [id, session] : sessions())
    wall_now() < deadline ? session->finish() : session->close(LineCloseReason::kShutdown);
  if (sessions_.empty()) watch_.close();
  for (const auto& [line, timer] : waiting_) timer->cancel();
  acted_();
}

void RobotPort::abort() {
  for (const auto& [id, session] : sessions()) session->close(LineCloseReason::kShutdown);
}

}  // namespace xr3
