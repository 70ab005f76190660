// epoll, edge- and level-triggered, and poll.
#include <algorithm>
#include <cerrno>

#include "tests/seeds/kernel.hpp"
#include "tests/seeds/thread.hpp"

namespace xr3::seeds {

int Kernel::new_watch() { return open({.kind = Kind::kWatch}); }

int Kernel::watch(Fd set, int operation, Fd fd, const epoll_event* event) {
  count_call();
  if (fd < kFirstFd && operation == EPOLL_CTL_ADD) files_.emplace(fd, File{.kind = Kind::kForeign});
  File* file = find(set);
  if (file == nullptr || file->kind != Kind::kWatch || find(fd) == nullptr) return refuse(EBADF);
  if (operation == EPOLL_CTL_DEL) return file->items.erase(fd) == 1 ? 0 : refuse(ENOENT);
  const bool is_new = !file->items.contains(fd);
  if (is_new != (operation == EPOLL_CTL_ADD)) return refuse(is_new ? ENOENT : EEXIST);
  // Asio does not notice if it cannot watch its pipe for signals, its timer or its waker.
  const Kind kind = find(fd)->kind;
  const bool is_socket = kind == Kind::kSocket || kind == Kind::kListener || kind == Kind::kStream;
  const bool may_fail = is_new && is_socket;
  if (may_fail && fault(faults_.watch)) {
    note("epoll_ctl fails", fd, 0);
    return refuse(random_.any_of({ENOSPC, ENOMEM}));
  }
  Item& item = file->items[fd];
  item = {event->events, event->data, true};
  if (ready_events(fd, item) != 0) signal(set);
  return 0;
}

// --- What is ready.

std::uint32_t Kernel::events_of(const Connection& connection, int side) {
  const Side& mine = connection.sides[side];
  const Stream& out = connection.sides[1 - side].in;
  std::uint32_t events = 0;
  const bool has_ended = mine.in.end_has_arrived || mine.reads_no_more || mine.is_reset;
  if (!mine.in.arrived.empty() || has_ended) events |= EPOLLIN;
  if (has_ended) events |= EPOLLRDHUP;
  if (mine.is_reset || mine.has_shut || 3 * out.room() > out.capacity) events |= EPOLLOUT;
  if (mine.is_reset || (mine.in.end_has_arrived && mine.has_shut)) events |= EPOLLHUP;
  if (mine.error != 0) events |= EPOLLERR;
  return events;
}

std::uint32_t Kernel::events_of(const File& file) const {
  switch (file.kind) {
    case Kind::kSocket: return EPOLLOUT | EPOLLHUP;
    case Kind::kListener: return file.backlog.empty() ? 0 : EPOLLIN;
    case Kind::kStream: return events_of(*file.connection, file.side);
    case Kind::kTimer: return now_ >= file.expiry ? EPOLLIN : 0;
    case Kind::kWaker: return EPOLLIN | EPOLLOUT;
    case Kind::kForeign: return EPOLLIN;
    case Kind::kWatch:
      return std::any_of(
                 file.items.begin(), file.items.end(),
                 [this](const auto& each) { return ready_events(each.first, each.second) != 0; })
                 ? EPOLLIN
                 : 0;
  }
  return 0;
}

std::uint32_t Kernel::ready_events(Fd fd, const Item& item) const {
  if ((item.events & EPOLLET) != 0 && !item.has_news) return 0;
  const std::uint32_t wanted = item.events | EPOLLERR | EPOLLHUP;
  return events_of(files_.at(fd)) & wanted;
}

/// Something has happened to the file: those who watch it hear of it.
void Kernel::signal(Fd fd) {
  if (fd == kNoFd) return;
  for (auto& [set, file] : files_) {
    const auto found = file.items.find(fd);
    if (found == file.items.end()) continue;
    found->second.has_news = true;
    signal(set);
  }
}

// --- Waiting.

// The order is the seed's: programs must not rely on it.
int Kernel::collect(File& set, std::span<epoll_event> events) {
  std::vector<std::pair<Fd, Item*>> items;
  for (auto& [fd, item] : set.items) {
    if (spurious_ < kMaxSpurious && fault(faults_.spurious)) item.has_news = ++spurious_ > 0;
    if (ready_events(fd, item) != 0) items.emplace_back(fd, &item);
  }
  std::size_t count = 0;
  while (!items.empty() && count < events.size()) {
    const auto next = items.begin() + static_cast<std::ptrdiff_t>(random_.below(items.size()));
    const auto [fd, item] = *next;
    items.erase(next);
    events[count].events = ready_events(fd, *item);
    events[count].data = item->data;
    item->has_news = false;
    ++count;
  }
  return static_cast<int>(count);
}

void Kernel::let_worker_run() {
  if (worker_thread().is_ready() && fault(faults_.worker)) worker_thread().take_turn();
}

int Kernel::wait(Fd set, std::span<epoll_event> events, int timeout) {
  for (;;) {
    count_call();
    if (!failure_.empty()) throw Failure();
    let_worker_run();
    if (timeout != 0 && fault(faults_.interrupted)) return refuse(EINTR);
    const int count = collect(*find(set), events);
    note("epoll_wait", set, count);
    if (count > 0 || timeout == 0) return count;
    calls_ = spurious_ = 0;
    idle();
  }
}

int Kernel::poll(Fd fd, int events, int timeout) {
  count_call();
  const std::uint32_t wanted = static_cast<std::uint32_t>(events) | EPOLLERR | EPOLLHUP;
  const std::uint32_t ready = events_of(*find(fd)) & wanted;
  if (ready == 0 && timeout != 0) {
    fail("poll() blocks the server");
    throw Failure();
  }
  return static_cast<int>(ready);
}

}  // namespace xr3::seeds
