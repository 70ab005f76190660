#include "server/pty/pseudo_terminal.hpp"

#include <asm/termbits.h>  // termios2, which has the speed as a number; not together with termios.h
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "server/files/data_files.hpp"

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

PseudoTerminal::PseudoTerminal(::mode_t rights) {
  try {
    make(rights);
  } catch (const FileError&) {
    if (master_ >= 0) ::close(master_);
    throw;
  }
}

void PseudoTerminal::make(::mode_t rights) {
  std::array<char, 64> name{};
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0) fail_to("opened");
  if (::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
      ::ptsname_r(master_, name.data(), name.size()) != 0)
    fail_to("unlocked");
  slave_ = name.data();
  if (::chmod(name.data(), rights) != 0) fail_to("given its mode");
  prepare();
}

PseudoTerminal::PseudoTerminal(PseudoTerminal&& other) noexcept
    : master_(std::exchange(other.master_, -1)), slave_(std::move(other.slave_)) {}

PseudoTerminal& PseudoTerminal::operator=(PseudoTerminal&& other) noexcept {
  std::swap(master_, other.master_);
  std::swap(slave_, other.slave_);
  return *this;
}

PseudoTerminal::~PseudoTerminal() {
  if (master_ >= 0) ::close(master_);
}

bool PseudoTerminal::has_client() const {
  assert(master_ >= 0);
  ::pollfd state{master_, POLLIN, 0};
  if (::poll(&state, 1, 0) < 0) return false;
  return (state.revents & POLLIN) != 0 || (state.revents & POLLHUP) == 0;
}

bool PseudoTerminal::has_room() const {
  ::pollfd state{master_, POLLOUT, 0};
  return ::poll(&state, 1, 0) != 0;
}

// The master reports POLLHUP only after the slave has been open once, and the slave alone can
// discard what its programs have not read.
void PseudoTerminal::prepare() const {
  make_raw(master_);
  const int slave = ::open(slave_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (slave < 0) fail_to("opened");
  ::ioctl(slave, TCFLSH, TCIFLUSH);
  ::close(slave);
}

PtyModes PseudoTerminal::modes() const {
  struct termios2 modes {};
  if (::ioctl(master_, TCGETS2, &modes) != 0) return {};
  return {modes.c_ospeed, (modes.c_lflag & (ECHO | ICANON)) != 0};
}

}  // namespace xr3
