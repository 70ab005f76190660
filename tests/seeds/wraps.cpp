// The system calls of the server, which the linker redirects to here (--wrap in CMakeLists.txt).
// Descriptors of the kernel in memory go there, all others to the system.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <string>
#include <vector>

#include "tests/seeds/kernel.hpp"
#include "tests/seeds/memory.hpp"

using xr3::seeds::current_kernel;
using xr3::seeds::Kernel;
using xr3::seeds::Outside;

namespace {

Kernel* kernel_with(int fd) {
  Kernel* kernel = current_kernel;
  return kernel != nullptr && kernel->has(fd) ? kernel : nullptr;
}

/// Runs a call of the kernel in memory; what it allocates is not the server's.
template <class Call>
auto in_kernel(const Call& call) {
  const Outside outside;
  return call();
}

int give_address(int port, sockaddr* address, socklen_t* size) {
  if (port < 0) return -1;
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::memcpy(address, &place, std::min<std::size_t>(*size, sizeof place));
  *size = sizeof place;
  return 0;
}

std::uint16_t port_in(const sockaddr* address) {
  sockaddr_in place{};
  std::memcpy(&place, address, sizeof place);
  return ntohs(place.sin_port);
}

bool may_wait(int flags) { return (flags & MSG_DONTWAIT) == 0; }

ssize_t no_such_call(const char* name) {
  if (Kernel* kernel = current_kernel) kernel->fail(std::string("unexpected call: ") + name);
  errno = ENOSYS;
  return -1;
}

}  // namespace

extern "C" {

int __real_close(int);
int __real_fcntl(int, int, ...);
int __real_ioctl(int, unsigned long, ...);
int __real_poll(pollfd*, nfds_t, int);

// --- Sockets.

int __wrap_socket(int, int, int) {
  return in_kernel([] { return current_kernel->socket(); });
}
int __wrap_bind(int fd, const sockaddr* address, socklen_t) {
  return in_kernel([&] { return current_kernel->bind(fd, port_in(address)); });
}
int __wrap_listen(int fd, int) {
  return in_kernel([&] { return current_kernel->listen(fd); });
}
int __wrap_accept4(int fd, sockaddr* address, socklen_t* size, int flags) {
  return in_kernel([&] {
    const int accepted = current_kernel->accept(fd, (flags & SOCK_NONBLOCK) == 0);
    if (accepted >= 0) give_address(current_kernel->peer_of_accepted(accepted), address, size);
    return accepted;
  });
}
int __wrap_getsockname(int fd, sockaddr* address, socklen_t* size) {
  return in_kernel([&] { return give_address(current_kernel->port_of(fd, false), address, size); });
}
int __wrap_getpeername(int fd, sockaddr* address, socklen_t* size) {
  return in_kernel([&] { return give_address(current_kernel->port_of(fd, true), address, size); });
}

ssize_t __wrap_recv(int fd, void* into, size_t size, int flags) {
  return in_kernel([&] {
    return current_kernel->receive(fd, {static_cast<char*>(into), size}, may_wait(flags));
  });
}
ssize_t __wrap___recv_chk(int fd, void* into, size_t size, size_t, int flags) {
  return __wrap_recv(fd, into, size, flags);
}
ssize_t __wrap_recvmsg(int fd, msghdr* message, int flags) {
  return in_kernel([&] {  // one buffer suffices: a stream may give fewer bytes than wanted
    const iovec* part = message->msg_iov;
    const iovec* const end = part + message->msg_iovlen;
    while (part != end && part->iov_len == 0) ++part;
    if (part == end) return ssize_t{0};
    return current_kernel->receive(fd, {static_cast<char*>(part->iov_base), part->iov_len},
                                   may_wait(flags));
  });
}
ssize_t __wrap_send(int fd, const void* bytes, size_t size, int flags) {
  return in_kernel([&] {
    const std::string_view part(static_cast<const char*>(bytes), size);
    return current_kernel->send(fd, {&part, 1}, may_wait(flags));
  });
}
ssize_t __wrap_sendmsg(int fd, const msghdr* message, int flags) {
  return in_kernel([&] {
    std::vector<std::string_view> parts;
    for (std::size_t i = 0; i < message->msg_iovlen; ++i) {
      const iovec& part = message->msg_iov[i];
      parts.emplace_back(static_cast<const char*>(part.iov_base), part.iov_len);
    }
    return current_kernel->send(fd, parts, may_wait(flags));
  });
}
int __wrap_shutdown(int fd, int how) {
  return in_kernel([&] { return current_kernel->shut(fd, how); });
}
int __wrap_setsockopt(int fd, int level, int name, const void* value, socklen_t) {
  return in_kernel([&] {
    int number = 0;
    std::memcpy(&number, value, sizeof number);
    if (level == SOL_SOCKET && name == SO_KEEPALIVE) current_kernel->set_keepalive(fd);
    if (level == IPPROTO_TCP && name == TCP_USER_TIMEOUT)
      current_kernel->set_max_unacknowledged(fd, number * xr3::seeds::kMillisecond);
    return 0;
  });
}
int __wrap_getsockopt(int fd, int, int name, void* value, socklen_t*) {
  return in_kernel([&] {
    const int number = name == SO_ERROR ? current_kernel->take_error(fd) : 0;
    std::memcpy(value, &number, sizeof number);
    return 0;
  });
}

// --- Waiting.

int __wrap_epoll_create1(int) {
  return in_kernel([] { return current_kernel->new_watch(); });
}
int __wrap_epoll_ctl(int set, int operation, int fd, epoll_event* event) {
  return in_kernel([&] { return current_kernel->watch(set, operation, fd, event); });
}
int __wrap_epoll_wait(int set, epoll_event* events, int most, int timeout) {
  return in_kernel([&] {
    return current_kernel->wait(set, {events, static_cast<std::size_t>(most)}, timeout);
  });
}
int __wrap_poll(pollfd* files, nfds_t count, int timeout) {
  if (count != 1 || kernel_with(files->fd) == nullptr) return __real_poll(files, count, timeout);
  return in_kernel([&] {
    const int events = current_kernel->poll(files->fd, files->events, timeout);
    files->revents = static_cast<short>(events);
    return events == 0 ? 0 : 1;
  });
}
int __wrap___poll_chk(pollfd* files, nfds_t count, int timeout, size_t) {
  return __wrap_poll(files, count, timeout);
}
int __wrap_eventfd(unsigned, int) {
  return in_kernel([] { return current_kernel->new_waker(); });
}
int __wrap_timerfd_create(int, int) {
  return in_kernel([] { return current_kernel->new_timer(); });
}
int __wrap_timerfd_settime(int fd, int flags, const itimerspec* wanted, itimerspec*) {
  return in_kernel([&] {
    const auto& [seconds, nanoseconds] = wanted->it_value;
    const xr3::seeds::Ns time = seconds * xr3::seeds::kSecond + nanoseconds;
    const bool is_absolute = (flags & TFD_TIMER_ABSTIME) != 0;
    current_kernel->set_timer(fd, is_absolute ? time : current_kernel->now() + time);
    return 0;
  });
}

// --- Any descriptor.

int __wrap_close(int fd) {
  Kernel* kernel = kernel_with(fd);
  const int result = fd >= xr3::seeds::kFirstFd ? 0 : __real_close(fd);
  if (kernel == nullptr && fd < xr3::seeds::kFirstFd) return result;
  return in_kernel([&] { return current_kernel->close(fd); });
}
int __wrap_fcntl(int fd, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (kernel_with(fd) == nullptr) return __real_fcntl(fd, command, argument);
  const auto flags = reinterpret_cast<std::uintptr_t>(argument);
  if (command == F_SETFL) current_kernel->set_blocking(fd, (flags & O_NONBLOCK) == 0);
  return 0;
}
int __wrap_ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (kernel_with(fd) == nullptr) return __real_ioctl(fd, request, argument);
  if (request == FIONBIO) current_kernel->set_blocking(fd, *static_cast<int*>(argument) == 0);
  return 0;
}
// Calls that the server does not use today: they would need a place in the kernel in memory.
ssize_t __wrap_sendto(int, const void*, size_t, int, const sockaddr*, socklen_t) {
  return no_such_call("sendto");
}
int __wrap_accept(int, sockaddr*, socklen_t*) { return static_cast<int>(no_such_call("accept")); }
int __wrap_connect(int, const sockaddr*, socklen_t) {
  return static_cast<int>(no_such_call("connect"));
}

}  // extern "C"
