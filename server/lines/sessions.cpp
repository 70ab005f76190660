#include "server/lines/sessions.hpp"

#include <utility>

#include "cell/failure.hpp"

namespace xr3 {
namespace {

constexpr const char* kLinesName = "the serial lines";

// The time of arrived bytes until other ports have their turns.
constexpr WallNs kPiece = 500'000;

/// While it exists, the timer is cancelled when bytes of the line have been executed.
class ByteWait {
 public:
  using Timers = std::multimap<LineId, asio::steady_timer*>;
  ByteWait(Timers& all, LineId line, asio::steady_timer& timer)
      : all_(all), place_(all.emplace(line, &timer)) {}
  ByteWait(const ByteWait&) = delete;
  ByteWait& operator=(const ByteWait&) = delete;
  ~ByteWait() { all_.erase(place_); }

 private:
  Timers& all_;
  Timers::iterator place_;
};

}  // namespace

LineSessions::LineSessions(LineTurns& turns, Cell& cell, std::function<void()> on_input)
    : turns_(turns),
      cell_(cell),
      on_input_(std::move(on_input)),
      context_{cell, turns, [this](LineId line) { notify(line); },
               [this](LineId line, LineCloseReason reason) { end(line, reason); }} {}

std::optional<LineId> LineSessions::open(LineSource& source, std::unique_ptr<LineStream> stream,
                                         const LineOpened& opened, PeerCounts::Place place) {
  const auto session =
      std::make_shared<LineSession>(std::move(stream), opened, context_, source, std::move(place));
  const LineId line = session->line();
  SessionEntry& entry = sessions_[line];
  if (entry.number) turns_.remove(*entry.number);
  entry = {session, turns_.add(session)};
  if (!entry.number) {
    session->close(LineCloseReason::kError);
    return std::nullopt;
  }
  notify(line);
  return line;
}

void LineSessions::end(LineId line, LineCloseReason reason) {
  const auto ended = sessions_.extract(line);
  if (ended && ended.mapped().number) turns_.remove(*ended.mapped().number);
  if (ended) ended.mapped().session->source().line_ended(line, reason);
  notify(line);
}

PortCounters LineSessions::counters() const {
  PortCounters all;
  for (const LineSource* source : sources_) all += source->counters();
  return all;
}

bool LineSessions::disconnect(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return false;
  const auto session = found->second.session;  // the session removes itself from the map
  session->close(LineCloseReason::kDisconnected);
  return true;
}

void LineSessions::wake(LineId line) {
  const auto found = sessions_.find(line);
  if (found != sessions_.end() && found->second.number) turns_.wake(*found->second.number);
}

void LineSessions::drop() {
  for (const auto& [line, entry] : sessions_)
    if (entry.number) turns_.remove(*entry.number);
  sessions_.clear();
}

// --- Barriers.

void LineSessions::accept_arrived() {
  for (LineSource* source : sources_) source->accept_arrived();
}

ArrivedBytes LineSessions::arrived(const std::function<bool(const LineSession&)>& matches) {
  accept_arrived();
  ArrivedBytes bytes(turns_);
  for (const auto& [line, entry] : sessions_)
    if (entry.number && matches(*entry.session)) bytes.add(*entry.number, entry.session);
  return bytes;
}

asio::awaitable<void> LineSessions::read(ArrivedBytes bytes) {
  const auto read_some = [&bytes] { return bytes.read(wall_now() + kPiece); };
  while (fatal_if_throws(kLinesName, read_some)) co_await turns_.pause();
}

asio::awaitable<void> LineSessions::read_arrived() {
  for (LineSource* source : sources_) co_await source->settle();
  co_await read(fatal_if_throws(
      kLinesName, [this] { return arrived([](const LineSession&) { return true; }); }));
}

asio::awaitable<void> LineSessions::read_lines_of(const LineSource& source) {
  co_await read(fatal_if_throws(kLinesName, [&, this] {
    return arrived([&source](const LineSession& each) { return &each.source() == &source; });
  }));
}

asio::awaitable<bool> LineSessions::wait_for_bytes(LineId id, std::uint64_t bytes_in,
                                                   std::chrono::milliseconds within) {
  asio::steady_timer timer(turns_.io(), within);
  const auto deadline = timer.expiry();
  for (;;) {
    co_await read(fatal_if_throws(kLinesName, [id, this] {
      return arrived([id](const LineSession& each) { return each.line() == id; });
    }));
    if (cell_.bytes_in(id).value_or(0) >= bytes_in) co_return true;
    const bool may_come = cell_.find_line(id) != nullptr && !is_closing_;
    if (!may_come || asio::steady_timer::clock_type::now() >= deadline) co_return false;
    const ByteWait waiting(waiting_, id, timer);
    co_await timer.async_wait(kAwait);
  }
}

// Resumes the coroutines that wait for bytes of the line, which check again.
void LineSessions::notify(LineId line) {
  fatal_if_throws(kLinesName, [&, this] {
    const auto [begin, end] = waiting_.equal_range(line);
    for (auto each = begin; each != end; ++each) each->second->cancel();
    on_input_();
  });
}

// --- The end.

void LineSessions::close(WallNs deadline) {
  is_closing_ = true;
  for (const auto& [id, entry] : sessions())
    wall_now() < deadline ? entry.session->finish()
                          : entry.session->close(LineCloseReason::kShutdown);
  for (const auto& [line, timer] : waiting_) timer->cancel();
  on_input_();
}

void LineSessions::abort(LineCloseReason reason) {
  for (const auto& [id, entry] : sessions()) entry.session->close(reason);
}

}  // namespace xr3
