#include "cli/exec/stop_signals.hpp"

#include <sys/signalfd.h>

#include "cli/exec/throw_errno.hpp"

namespace xr3 {

StopSignals::StopSignals() {
  sigset_t both;
  ::sigemptyset(&both);
  ::sigaddset(&both, SIGINT);
  ::sigaddset(&both, SIGTERM);
  if (::sigprocmask(SIG_BLOCK, &both, &before_) != 0) throw_errno("sigprocmask");
  signals_ = Descriptor(::signalfd(-1, &both, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!signals_.is_open()) throw_errno("signalfd");
}

bool StopSignals::take() {
  if (!signals_.is_open()) return false;
  signalfd_siginfo signal{};
  bool has_one = false;
  while (::read(signals_.get(), &signal, sizeof signal) == sizeof signal) has_one = true;
  if (!has_one) return false;
  signals_ = Descriptor();
  release();
  return true;
}

void StopSignals::release() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace xr3
