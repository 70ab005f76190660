#include "server/line_watch.hpp"

#include <unistd.h>

namespace xr3 {

// Without a set (no descriptor is left) there is never any news.
LineWatch::LineWatch() : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}

LineWatch::~LineWatch() { ::close(epoll_); }

void LineWatch::add(int descriptor, LineId line) {
  epoll_event event{};
  event.events = EPOLLIN | EPOLLET;
  event.data.u32 = line;
  ::epoll_ctl(epoll_, EPOLL_CTL_ADD, descriptor, &event);
}

std::span<const LineId> LineWatch::news() {
  const int count = ::epoll_wait(epoll_, events_.data(), kMostNews, 0);
  std::size_t told = 0;
  while (static_cast<int>(told) < count) {
    lines_[told] = events_[told].data.u32;
    ++told;
  }
  return {lines_.data(), told};
}

}  // namespace xr3
