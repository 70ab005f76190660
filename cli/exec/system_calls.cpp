#include "cli/exec/system_calls.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/keyctl.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>

namespace xr3 {
namespace {

#if defined(__x86_64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#else
#error "the architecture of system calls is unknown: add it"
#endif

// On x86-64 a bit of the number selects a second table of the same calls.
constexpr unsigned kSecondTable = 0x40000000;
static_assert(SYS_add_key + 1 == SYS_request_key && SYS_request_key + 1 == SYS_keyctl);

constexpr sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
}

constexpr sock_filter result(unsigned value) { return BPF_STMT(BPF_RET | BPF_K, value); }

constexpr unsigned refused(int error) { return SECCOMP_RET_ERRNO | static_cast<unsigned>(error); }

constexpr sock_filter skip_if_equal(unsigned value, unsigned char count) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, count, 0);
}

std::array<sock_filter, 19> filter{
    load(offsetof(seccomp_data, arch)),
    skip_if_equal(kArchitecture, 1),
    result(refused(ENOSYS)),
    load(offsetof(seccomp_data, nr)),
    BPF_STMT(BPF_ALU | BPF_AND | BPF_K, ~kSecondTable),
    skip_if_equal(SYS_socket, 6),
    skip_if_equal(SYS_socketpair, 5),
    skip_if_equal(SYS_io_uring_setup, 2),  // io_uring can make sockets
    BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, SYS_add_key, 0, 2),
    BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, SYS_keyctl, 1, 0),
    result(refused(EPERM)),
    result(SECCOMP_RET_ALLOW),
    load(offsetof(seccomp_data, args)),  // the family; both architectures are little-endian
    skip_if_equal(AF_UNIX, 3),
    skip_if_equal(AF_INET, 2),
    skip_if_equal(AF_INET6, 1),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_NETLINK, 0, 1),
    result(SECCOMP_RET_ALLOW),
    result(refused(EAFNOSUPPORT)),
};

}  // namespace

bool restrict_system_calls() {
  ::syscall(SYS_keyctl, KEYCTL_JOIN_SESSION_KEYRING, nullptr);
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace xr3
