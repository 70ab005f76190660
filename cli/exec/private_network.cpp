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
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

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

bool send_descriptors(int channel, const Descriptors& descriptors) {
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Descriptors))> space{};
  char byte = 0;
  iovec data{&byte, 1};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = space.data();
  message.msg_controllen = space.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof(Descriptors));
  std::memcpy(CMSG_DATA(header), descriptors.data(), sizeof(Descriptors));
  return ::sendmsg(channel, &message, 0) == 1;
}

/// False if the other side has sent none.
bool receive_descriptors(int channel, Descriptors& descriptors) {
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Descriptors))> space{};
  char byte = 0;
  iovec data{&byte, 1};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = space.data();
  message.msg_controllen = space.size();
  if (::recvmsg(channel, &message, MSG_CMSG_CLOEXEC) != 1) return false;
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == nullptr || header->cmsg_type != SCM_RIGHTS) return false;
  std::memcpy(descriptors.data(), CMSG_DATA(header), sizeof(Descriptors));
  return true;
}

/// Closes every descriptor of the judge but the channel. Returns its new number.
int keep_channel(int channel) {
  constexpr int kChannel = STDERR_FILENO + 1;
  if (channel != kChannel) ::dup2(channel, kChannel);
  ::syscall(SYS_close_range, static_cast<unsigned>(kChannel) + 1U, ~0U, 0U);
  return kChannel;
}

/// In the child: makes the namespaces and sends their descriptors. Returns 0, or errno.
int make_namespaces(int judges_channel, const IdMaps& maps,
                    const std::optional<ProgramUser>& user) {
  const int channel = keep_channel(judges_channel);
  if (user && !user->enter()) return errno;
  if (::unshare(CLONE_NEWNET | CLONE_NEWUSER) != 0) return errno;
  if (!maps.write() || !write_to("/proc/sys/user/max_user_namespaces", kOfBubblewrap)) return errno;
  if (!bring_loopback_up()) return errno;
  const Descriptors descriptors{listen_on_loopback(),
                                ::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC),
                                ::open("/proc/self/ns/user", O_RDONLY | O_CLOEXEC)};
  for (const int each : descriptors)
    if (each < 0) return errno;
  return send_descriptors(channel, descriptors) ? 0 : errno;
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

PrivateNetwork::PrivateNetwork(const std::optional<ProgramUser>& user) {
  const IdMaps maps(user);
  std::array<int, 2> channel{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channel.data()) != 0)
    throw_errno("socketpair");
  const ::pid_t child = ::fork();
  if (child < 0) throw_errno("fork");
  if (child == 0) ::_exit(make_namespaces(channel[1], maps, user));
  ::close(channel[1]);
  Descriptors descriptors{-1, -1, -1};
  const bool is_made = receive_descriptors(channel[0], descriptors);
  ::close(channel[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!is_made) {
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
