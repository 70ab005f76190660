#include "server/pty/pseudo_terminal.hpp"

#include <asm/termbits.h>  // termios2, which has the speed as a number; not together with termios.h
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "server/files/data_files.hpp"
#include "server/files/interrupted.hpp"

namespace xr3 {
namespace {

[[noreturn]] void fail_to(const std::string& what) {
  throw FileError("a pseudo-terminal cannot be " + what + ": " + std::strerror(errno));
}

// IGNBRK has no effect, since there is no break. Programs that make a port raw clear it. Without
// this change, the C library of Debian would refuse their 7 bits or parity with EINVAL.
void make_raw(int master) {
  struct termios2 modes {};
  if (::ioctl(master, TCGETS2, &modes) != 0) fail_to("read");
  modes.c_iflag = IGNBRK;
  modes.c_oflag = 0;
  modes.c_lflag = 0;
  modes.c_cflag = B9600 | CS8 | CREAD | CLOCAL;
  modes.c_cc[VMIN] = 1;
  modes.c_cc[VTIME] = 0;
  if (::ioctl(master, TCSETS2, &modes) != 0) fail_to("made raw");
}

}  // namespace

PseudoTerminal::PseudoTerminal(::mode_t rights)
    : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
  std::array<char, 64> name{};
  if (!master_.is_open()) fail_to("opened");
  if (::grantpt(master()) != 0 || ::unlockpt(master()) != 0 ||
      ::ptsname_r(master(), name.data(), name.size()) != 0)
    fail_to("unlocked");
  slave_ = name.data();
  if (::chmod(name.data(), rights) != 0) fail_to("given its mode");
  prepare();
}

PseudoTerminal::TerminalState PseudoTerminal::poll() const {
  assert(master_.is_open());
  ::pollfd state{master(), POLLIN, 0};
  retry_interrupted([&state] { return ::poll(&state, 1, 0); });
  const auto has = [&state](int event) { return (state.revents & event) != 0; };
  return {!has(POLLHUP), has(POLLIN)};
}

// The master reports POLLHUP only after the slave has been open once, and the slave alone can
// discard what its programs have not read.
void PseudoTerminal::prepare() const {
  make_raw(master());
  const Descriptor slave(::open(slave_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!slave.is_open()) fail_to("opened");
  if (::ioctl(slave.get(), TCFLSH, TCIFLUSH) != 0) fail_to("flushed");
  if (::ioctl(slave.get(), TCXONC, TCOON) != 0) fail_to("started");
  if (::ioctl(slave.get(), TIOCNXCL) != 0) fail_to("shared");
}

PtyModes PseudoTerminal::modes() const {
  struct termios2 modes {};
  if (::ioctl(master(), TCGETS2, &modes) != 0) return {};
  return {modes.c_ospeed, (modes.c_lflag & (ECHO | ICANON)) != 0};
}

}  // namespace xr3
