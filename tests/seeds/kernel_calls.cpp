// System calls on sockets and timers.
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "tests/seeds/kernel.hpp"

namespace xr3::seeds {

// --- Sockets.

int Kernel::socket() {
  count_call();
  if (fault(faults_.socket)) return refuse(EMFILE);
  return open({.kind = Kind::kSocket});
}

int Kernel::bind(Fd fd, std::uint16_t port) {
  File* file = find(fd);
  if (file == nullptr) return refuse(EBADF);
  if (port != 0 && listener_at(port) != nullptr) return refuse(EADDRINUSE);
  file->port = port != 0 ? port : free_port();
  return 0;
}

int Kernel::listen(Fd fd) {
  File* file = find(fd);
  if (file == nullptr) return refuse(EBADF);
  file->kind = Kind::kListener;
  return 0;
}

int Kernel::accept(Fd fd, bool blocks) {
  count_call();
  File* listener = find(fd);
  if (listener == nullptr || listener->kind != Kind::kListener) return refuse(EINVAL);
  if (listener->backlog.empty()) {
    if (listener->blocks) fail("accept() blocks the server");
    return refuse(EAGAIN);
  }
  if (fault(faults_.accept)) {
    const int error =
        random_.any_of({EMFILE, ENFILE, ENOBUFS, ENOMEM, EINTR, ECONNABORTED, EPROTO, ENETDOWN});
    note("accept fails", fd, error);
    if (error != ECONNABORTED && error != EPROTO) return refuse(error);
    const ConnectionPtr lost = listener->backlog.front();
    listener->backlog.pop_front();
    lost->is_aborted = true;
    lost->sides[1].is_open = false;
    break_off(*lost, 0, ECONNRESET);
    return refuse(error);
  }
  const ConnectionPtr connection = listener->backlog.front();
  listener->backlog.pop_front();
  const Fd accepted =
      open({.kind = Kind::kStream, .blocks = blocks, .connection = connection, .side = 1});
  connection->sides[1].fd = accepted;
  note("accept of " + std::to_string(connection->ports[0]), fd, accepted);
  return accepted;
}

int Kernel::peer_of_accepted(Fd fd) {
  const File* file = find(fd);
  return file->connection->ports[1 - file->side];
}

// To the server's own port. It succeeds at once, but reports that later, as Linux does.
int Kernel::port_of(Fd fd, bool of_peer) {
  const File* file = find(fd);
  if (file == nullptr) return refuse(EBADF);
  if (file->kind != Kind::kStream) return of_peer ? refuse(ENOTCONN) : file->port;
  if (of_peer && file->connection->sides[file->side].is_reset) return refuse(ENOTCONN);
  return file->connection->ports[of_peer ? 1 - file->side : file->side];
}

ssize_t Kernel::receive(Fd fd, std::span<char> into, bool may_wait) {
  count_call();
  meanwhile();
  Side* side = side_of(fd);
  if (side == nullptr) return refuse(find(fd) == nullptr ? EBADF : ENOTCONN);
  if (fault(faults_.interrupted)) return refuse(EINTR);
  if (side->in.arrived.empty()) {
    if (side->error != 0) return refuse(std::exchange(side->error, 0));
    if (side->in.end_has_arrived || side->reads_no_more || side->is_reset) return 0;
    if (may_wait && find(fd)->blocks) fail("recv() blocks the server");
    return refuse(EAGAIN);
  }
  if (fault(faults_.again)) {
    signal(fd);
    return refuse(EAGAIN);
  }
  const std::size_t count = side->in.arrived.copy(into.data(), into.size());
  side->in.arrived.erase(0, count);
  made_room(*find(fd)->connection, find(fd)->side);
  note("recv", fd, static_cast<std::int64_t>(count));
  return static_cast<ssize_t>(count);
}

ssize_t Kernel::send(Fd fd, std::span<const std::string_view> parts, bool may_wait) {
  count_call();
  meanwhile();
  Side* side = side_of(fd);
  if (side == nullptr) return refuse(find(fd) == nullptr ? EBADF : ENOTCONN);
  if (side->error != 0) return refuse(std::exchange(side->error, 0));
  if (side->is_reset || side->has_shut) return refuse(EPIPE);
  File& file = *find(fd);
  Stream& out = file.connection->sides[1 - file.side].in;
  const bool is_full = out.room() == 0;
  if (is_full || fault(faults_.again)) {
    if (may_wait && file.blocks) fail("send() blocks the server");
    side->wants_room = true;
    if (!is_full) signal(fd);
    return refuse(EAGAIN);
  }
  std::size_t room = out.room();
  if (fault(faults_.shorter)) {
    room = random_.spread(room);
    signal(fd);
  }
  std::size_t count = 0;
  for (const std::string_view part : parts) {
    const std::size_t taken = std::min(part.size(), room - count);
    out.sent.append(part.substr(0, taken));
    count += taken;
    if (taken < part.size()) side->wants_room = true;
  }
  note("send", fd, static_cast<std::int64_t>(count));
  return static_cast<ssize_t>(count);
}

int Kernel::shut(Fd fd, int how) {
  count_call();
  Side* side = side_of(fd);
  if (side == nullptr || side->is_reset) return refuse(ENOTCONN);
  const File& file = *find(fd);
  if (how != SHUT_RD) shut(*file.connection, file.side);
  if (how != SHUT_WR) side->reads_no_more = true;
  signal(fd);
  note("shutdown", fd, how);
  return 0;
}

int Kernel::take_error(Fd fd) {
  Side* side = side_of(fd);
  return side == nullptr ? 0 : std::exchange(side->error, 0);
}

void Kernel::set_blocking(Fd fd, bool blocks) {
  if (File* file = find(fd)) file->blocks = blocks;
}

void Kernel::set_keepalive(Fd fd) {
  if (Side* side = side_of(fd)) {
    side->keeps_alive = true;
  } else if (File* file = find(fd)) {
    file->keeps_alive = true;
  }
}

void Kernel::set_max_unacknowledged(Fd fd, Ns time) {
  if (Side* side = side_of(fd)) side->max_unacknowledged = time;
}

int Kernel::close(Fd fd) {
  File* file = find(fd);
  if (file == nullptr) {
    fail("the server closes a descriptor that is not open");
    return refuse(EBADF);
  }
  note("close", fd, 0);
  for (auto& [set, each] : files_) each.items.erase(fd);
  if (file->kind == Kind::kStream) {
    file->connection->sides[file->side].fd = kNoFd;
    close(*file->connection, file->side);
  }
  for (const ConnectionPtr& waiting : file->backlog) {
    waiting->sides[1].is_open = false;
    break_off(*waiting, 0, ECONNRESET);
  }
  files_.erase(fd);
  return 0;
}

// --- Timers and wakers.

int Kernel::new_timer() { return open({.kind = Kind::kTimer}); }

void Kernel::set_timer(Fd fd, Ns when) { find(fd)->expiry = when; }

int Kernel::new_waker() { return open({.kind = Kind::kWaker}); }

}  // namespace xr3::seeds
