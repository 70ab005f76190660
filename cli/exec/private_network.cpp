#include "cli/exec/private_network.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/exec/pipe.hpp"
#include "cli/exec/throw_errno.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kDescriptors = 3;  // listener, network namespace, user namespace
using Descriptors = std::array<int, kDescriptors>;

// The user namespaces that bubblewrap makes, one in the other: to mount, and for the program.
constexpr const char* kOfBubblewrap = "2";

bool write_to(const char* path, std::string_view text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  const bool is_written = file >= 0 && write_all(file, text);
  ::close(file);
  return is_written;
}

bool bring_loopback_up() {
  const Descriptor any(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  return ::ioctl(any.get(), SIOCSIFFLAGS, &request) == 0;
}

/// A socket that listens on a free port of loopback; -1 with errno.
int listen_on_loopback() {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool is_listening =
      ::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::listen(listener, SOMAXCONN) == 0;
  return is_listening ? listener : -1;
}

/// In the child: makes the namespaces, and writes their descriptors to `result`. Returns 0, or
/// errno.
int make_namespaces(int result, const IdMaps& maps, const std::optional<ProgramUser>& user) {
  if (user && !user->enter()) return errno;
  if (::unshare(CLONE_NEWNET | CLONE_NEWUSER) != 0) return errno;
  if (!maps.write() || !write_to("/proc/sys/user/max_user_namespaces", kOfBubblewrap)) return errno;
  if (!bring_loopback_up()) return errno;
  const Descriptors descriptors{listen_on_loopback(),
                                ::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC),
                                ::open("/proc/self/ns/user", O_RDONLY | O_CLOEXEC)};
  for (const int each : descriptors)
    if (each < 0) return errno;
  return ::write(result, descriptors.data(), sizeof descriptors) == sizeof descriptors ? 0 : errno;
}

}  // namespace

// The files below /proc/self are those of root while this process is not dumpable.
bool IdMaps::write() const {
  ::prctl(PR_SET_DUMPABLE, 1);
  const bool is_written = write_to("/proc/self/setgroups", "deny") &&
                          write_to("/proc/self/uid_map", user) &&
                          write_to("/proc/self/gid_map", group);
  ::prctl(PR_SET_DUMPABLE, 0);
  return is_written;
}

// The child shares the table of descriptors. (Descriptors sent over a socket count against a limit
// of the user until they are received, and a program of the same user could use the limit up.)
PrivateNetwork::PrivateNetwork(const std::optional<ProgramUser>& user) {
  const IdMaps maps(user);
  const Pipe result;
  const auto child = static_cast<::pid_t>(::syscall(SYS_clone, CLONE_FILES | SIGCHLD, 0, 0, 0, 0));
  if (child < 0) throw_errno("fork");
  if (child == 0) ::_exit(make_namespaces(result.writing.get(), maps, user));
  int status = 0;
  ::waitpid(child, &status, 0);
  Descriptors descriptors{-1, -1, -1};
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 ||
      ::read(result.reading.get(), descriptors.data(), sizeof descriptors) != sizeof descriptors) {
    errno = WIFEXITED(status) ? WEXITSTATUS(status) : EIO;
    throw_errno("user and network namespaces");
  }
  listener_ = Descriptor(descriptors[0]);
  network_ = Descriptor(descriptors[1]);
  user_ = Descriptor(descriptors[2]);
}

bool PrivateNetwork::enter() const {
  return ::setns(user_.get(), CLONE_NEWUSER) == 0 && ::setns(network_.get(), CLONE_NEWNET) == 0;
}

}  // namespace xr3
