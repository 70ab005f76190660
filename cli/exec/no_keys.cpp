#include "cli/exec/no_keys.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/keyctl.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
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

std::array<sock_filter, 9> kFilter{
    load(offsetof(seccomp_data, arch)),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
    result(refused(ENOSYS)),
    load(offsetof(seccomp_data, nr)),
    BPF_STMT(BPF_ALU | BPF_AND | BPF_K, ~kSecondTable),
    BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, SYS_add_key, 0, 2),
    BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, SYS_keyctl, 1, 0),
    result(refused(EPERM)),
    result(SECCOMP_RET_ALLOW),
};

}  // namespace

bool give_up_keys() {
  ::syscall(SYS_keyctl, KEYCTL_JOIN_SESSION_KEYRING, nullptr);
  const sock_fprog program{static_cast<unsigned short>(kFilter.size()), kFilter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace xr3
