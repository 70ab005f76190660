#include "server/device/serial_device.hpp"

#include <asm/termbits.h>  // termios2, which takes any speed; not together with termios.h
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

[[noreturn]] void refuse_device(const std::string& path, const std::string& why) {
  throw FileError(path + ": the serial device " + why);
}

std::string hint_for(int error) {
  switch (error) {
    case ENOENT: return "; plug it in, or look for its name with ls /dev/serial/by-id";
    case EACCES: return "; on Debian, members of the group dialout may";
    case EBUSY: return "; another program uses it";
    default: return "";
  }
}

tcflag_t frame_flags(const SerialFrame& frame) {
  constexpr tcflag_t kSizes[] = {CS5, CS6, CS7, CS8};
  tcflag_t flags = kSizes[frame.data_bits - kMinDataBits];
  if (frame.parity != Parity::kNone) flags |= PARENB;
  if (frame.parity == Parity::kOdd || frame.parity == Parity::kMark) flags |= PARODD;
  if (frame.parity == Parity::kMark || frame.parity == Parity::kSpace) flags |= CMSPAR;
  if (frame.stop_bits != StopBits::kOne) flags |= CSTOPB;
  if (frame.flow == FlowControl::kHardware) flags |= CRTSCTS;
  return flags;
}

// HUPCL is not set: at the end the arm keeps its lines.
bool set_modes(int descriptor, const SerialSettings& settings) {
  assert(settings.frame);
  struct termios2 modes {};
  if (::ioctl(descriptor, TCGETS2, &modes) != 0) return false;
  modes.c_iflag = settings.frame->flow == FlowControl::kSoftware ? IXON | IXOFF : 0;
  modes.c_oflag = 0;
  modes.c_lflag = 0;
  modes.c_cflag = CREAD | CLOCAL | BOTHER | frame_flags(*settings.frame);
  modes.c_ispeed = modes.c_ospeed = settings.baud;
  modes.c_cc[VMIN] = 1;
  modes.c_cc[VTIME] = 0;
  return ::ioctl(descriptor, TCSETS2, &modes) == 0 && ::ioctl(descriptor, TCFLSH, TCIOFLUSH) == 0;
}

/// Prepares an open port. Returns why it cannot be used; empty: it can.
std::string prepare(int descriptor, const SerialSettings& settings) {
  if (::isatty(descriptor) == 0) return "is not a serial port";
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return "is locked by another program";
  if (::ioctl(descriptor, TIOCEXCL) != 0 || !set_modes(descriptor, settings))
    return std::string("cannot be set up: ") + std::strerror(errno);
  return {};
}

}  // namespace

int open_serial_device(const std::string& path, const SerialSettings& settings) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    const int error = errno;
    refuse_device(path, std::string("cannot be opened: ") + std::strerror(error) + hint_for(error));
  }
  const std::string why = prepare(descriptor, settings);
  if (why.empty()) return descriptor;
  ::close(descriptor);
  refuse_device(path, why);
}

void discard_output(int descriptor) { ::ioctl(descriptor, TCFLSH, TCOFLUSH); }

}  // namespace xr3
