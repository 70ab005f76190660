#include "server/pty/port.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/system/system_error.hpp>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "cell/failure.hpp"
#include "server/files/data_files.hpp"
#include "server/net/spawn.hpp"
#include "server/pty/stream.hpp"

namespace xr3 {
namespace {

constexpr const char* kPtyName = "the pseudo-terminals";

/// A copy, which its owner may close.
int copy_of(int descriptor) {
  const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (copy < 0)
    throw FileError(std::string("a pseudo-terminal cannot be watched: ") + std::strerror(errno));
  return copy;
}

}  // namespace

PtyPort::Terminal::Terminal(asio::io_context& io, const std::string& path, ::mode_t rights)
    : watch(path, rights), news(io, copy_of(watch.news().descriptor())) {}

PtyPort::PtyPort(asio::io_context& io, LineSessions& lines)
    : io_(io), lines_(lines), round_ended_(io, asio::steady_timer::time_point::max()) {}

void PtyPort::serve(const std::vector<std::string>& paths, ::mode_t rights) {
  assert(terminals_.empty());
  for (const std::string& path : paths) terminals_.emplace_back(io_, path, rights);
  lines_.add(*this);
  for (Terminal& terminal : terminals_)
    spawn_loop(io_.get_executor(), kPtyName, follow_news(terminal));
}

void PtyPort::close() {
  is_closing_ = true;
  ErrorCode ignored;
  for (Terminal& terminal : terminals_) terminal.news.close(ignored);
  round_ended_.cancel();
}

asio::awaitable<void> PtyPort::follow_news(Terminal& terminal) {
  while (!is_closing_) {
    const auto [error] =
        co_await terminal.news.async_wait(asio::posix::stream_descriptor::wait_read, kAwait);
    if (is_closing_) co_return;
    if (error) throw boost::system::system_error(error, "eventfd");
    vital(kPtyName, [&, this] { take_news(terminal); });
  }
}

void PtyPort::take_news(Terminal& terminal) {
  terminal.watch.news().take();
  const int error = terminal.watch.error();
  if (error != 0)
    throw boost::system::system_error(error, boost::system::system_category(), "epoll");
  round_ended_.cancel();
  accept(terminal);
  report(terminal);
}

asio::awaitable<void> PtyPort::settle() {
  std::vector<std::pair<const PtyWatch*, std::uint64_t>> rounds;
  for (Terminal& each : terminals_) rounds.emplace_back(&each.watch, each.watch.begin_round());
  for (const auto& [watch, round] : rounds)
    while (!is_closing_ && !watch->has_ended(round)) co_await round_ended_.async_wait(kAwait);
}

void PtyPort::accept_arrived() {
  for (Terminal& terminal : terminals_) accept(terminal);
}

// A program that has left before its line began is noticed when the thread polls.
void PtyPort::accept(Terminal& terminal) {
  PtyPlace& place = terminal.watch.place();
  if (is_closing_ || place.stage() != PtyPlace::Stage::kArrived) return;
  ++progress_;
  terminal.line = lines_.open(*this, std::make_unique<PtyStream>(terminal.watch),
                              LineOpened{place.path(), LineKind::kPty});
  if (!terminal.line) place.end_line(true);
  terminal.watch.poll_soon();
}

void PtyPort::report(Terminal& terminal) {
  const PtyPlace& place = terminal.watch.place();
  const bool has_failed = place.stage() == PtyPlace::Stage::kFailed;
  if (has_failed == std::exchange(terminal.has_failed, has_failed)) return;
  if (has_failed)
    spdlog::error("{}: {}; it is tried again every second", place.path(), place.failure());
  else
    spdlog::info("{}: the pseudo-terminal is served again", place.path());
}

// A program whose line the server has ended sees a hangup, as if the plug of an adapter were
// pulled: its terminal is replaced.
void PtyPort::line_ended(LineId line, LineCloseReason reason) {
  const auto ended = std::ranges::find(terminals_, std::optional(line), &Terminal::line);
  if (is_closing_ || ended == terminals_.end()) return;
  ++progress_;
  ended->line.reset();
  ended->watch.place().end_line(reason != LineCloseReason::kClientClosed);
  ended->watch.poll_soon();
}

}  // namespace xr3
