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

PtyPort::PtyPort(asio::io_context& io, LineSessions& lines)
    : io_(io), lines_(lines), news_(io), attended_(io, asio::steady_timer::time_point::max()) {}

void PtyPort::serve(const std::vector<std::string>& paths, ::mode_t rights) {
  assert(!watch_);
  if (paths.empty()) return;
  watch_.emplace(paths, rights);
  news_.assign(copy_of(watch_->news().descriptor()));
  for (PtyPlace& place : watch_->places()) served_.push_back({place, std::nullopt});
  lines_.add(*this);
  spawn_loop(io_.get_executor(), kPtyName, follow_news());
}

void PtyPort::close() {
  is_closing_ = true;
  ErrorCode ignored;
  news_.close(ignored);
  attended_.cancel();
}

asio::awaitable<void> PtyPort::follow_news() {
  while (news_.is_open()) {
    const auto [error] =
        co_await news_.async_wait(asio::posix::stream_descriptor::wait_read, kAwait);
    if (is_closing_) co_return;
    if (error) throw boost::system::system_error(error, "eventfd");
    vital(kPtyName, [this] { take_news(); });
  }
}

void PtyPort::take_news() {
  watch_->news().take();
  const int failure = watch_->failure();
  if (failure != 0)
    throw boost::system::system_error(failure, boost::system::system_category(), "epoll");
  attended_.cancel();
  accept_arrived();
  for (Served& served : served_) report(served);
}

asio::awaitable<void> PtyPort::settle() {
  if (!watch_ || is_closing_) co_return;
  const std::uint64_t round = watch_->attend_to_all();
  while (!is_closing_ && !watch_->has_attended(round)) co_await attended_.async_wait(kAwait);
}

void PtyPort::accept_arrived() {
  if (is_closing_) return;
  for (Served& served : served_)
    if (served.place.stage() == PtyPlace::Stage::kArrived) open_line(served);
}

// A program that has left before its line began is noticed when the thread attends to the place.
void PtyPort::open_line(Served& served) {
  served.line = lines_.open(*this, std::make_unique<PtyStream>(*watch_, served.place),
                            LineOpened{served.place.path(), LineKind::kPty});
  if (!served.line) served.place.end_line(true);
  watch_->attend(served.place);
}

void PtyPort::report(Served& served) {
  const bool has_failed = served.place.stage() == PtyPlace::Stage::kFailed;
  if (has_failed == std::exchange(served.has_failed, has_failed)) return;
  if (has_failed)
    spdlog::error("{}: {}; it is tried again every second", served.place.path(),
                  served.place.failure());
  else
    spdlog::info("{}: the pseudo-terminal is served again", served.place.path());
}

// A program whose line the server has ended sees a hangup, as if the plug of an adapter were
// pulled: its terminal is replaced.
void PtyPort::line_ended(LineId line, LineCloseReason reason) {
  const auto served = std::ranges::find(served_, std::optional(line), &Served::line);
  if (is_closing_ || served == served_.end()) return;
  served->line.reset();
  served->place.end_line(reason != LineCloseReason::kClientClosed);
  watch_->attend(served->place);
}

}  // namespace xr3
