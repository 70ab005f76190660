#include "server/lines/watch.hpp"

#include <boost/system/system_error.hpp>
#include <cerrno>

namespace xr3 {
namespace {

int new_set() {
  const int set = ::epoll_create1(EPOLL_CLOEXEC);
  if (set < 0) throw boost::system::system_error(errno, boost::system::system_category(), "epoll");
  return set;
}

}  // namespace

LineWatch::LineWatch(asio::io_context& io) : set_(io, new_set()) {}

bool LineWatch::add(int descriptor, SessionNumber session) {
  epoll_event event{};
  event.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET;
  event.data.u32 = session;
  return ::epoll_ctl(set_.native_handle(), EPOLL_CTL_ADD, descriptor, &event) == 0;
}

asio::awaitable<bool> LineWatch::wait() {
  if (!set_.is_open()) co_return false;
  const auto [error] = co_await set_.async_wait(asio::posix::stream_descriptor::wait_read, kAwait);
  if (error && set_.is_open()) throw boost::system::system_error(error, "epoll");
  co_return set_.is_open();
}

void LineWatch::close() {
  ErrorCode ignored;
  set_.close(ignored);
}

std::span<const LineWatch::WatchEvent> LineWatch::poll() {
  if (!set_.is_open()) return {};
  const int count = ::epoll_wait(set_.native_handle(), events_.data(), kMaxEvents, 0);
  std::size_t filled = 0;
  for (; static_cast<int>(filled) < count; ++filled) {
    const epoll_event& event = events_[filled];
    const bool is_end = (event.events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0;
    reported_[filled] = {event.data.u32, is_end, (event.events & EPOLLERR) != 0};
  }
  return {reported_.data(), filled};
}

}  // namespace xr3
