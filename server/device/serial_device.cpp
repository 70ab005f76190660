#include "server/device/serial_device.hpp"

#include <fcntl.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>

#include "server/files/descriptor.hpp"

namespace xr3 {
namespace {

const std::map<std::uint32_t, speed_t>& speeds() {
  static const std::map<std::uint32_t, speed_t> all{
      {50, B50},       {75, B75},         {110, B110},       {134, B134},       {150, B150},
      {200, B200},     {300, B300},       {600, B600},       {1200, B1200},     {1800, B1800},
      {2400, B2400},   {4800, B4800},     {9600, B9600},     {19200, B19200},   {38400, B38400},
      {57600, B57600}, {115200, B115200}, {230400, B230400}, {460800, B460800}, {921600, B921600}};
  return all;
}

[[noreturn]] void refuse_device(const std::string& path, const std::string& why) {
  throw SerialDeviceError(path + ": " + why, false);
}

[[noreturn]] void refuse_used(const std::string& path) {
  throw SerialDeviceError(path + ": in use by another program", true);
}

/// The remedy for a missing permission; the group of serial devices is often dialout.
std::string advice_on_permission(const std::string& path) {
  struct stat status {};
  const bool is_known = ::stat(path.c_str(), &status) == 0;
  const ::group* group = is_known ? ::getgrgid(status.st_gid) : nullptr;  // NOLINT(*-mt-unsafe)
  if (group == nullptr || status.st_gid == 0) return "permission denied";
  return "permission denied; join its group with: sudo usermod -aG " + std::string(group->gr_name) +
         " USER (then log in again)";
}

[[noreturn]] void refuse_open(const std::string& path, int error) {
  switch (error) {
    case EACCES: refuse_device(path, advice_on_permission(path));
    case EBUSY: refuse_used(path);
    case ENOENT: refuse_device(path, "there is no such device; is it plugged in?");
    default: refuse_device(path, std::strerror(error));
  }
}

// Whether the device is the controlling terminal. Not compared by inode: /dev/tty is another name
// of the terminal.
bool is_same_terminal(int device) {
  unsigned int mine = 0;
  unsigned int other = 0;
  return ::ioctl(STDIN_FILENO, TIOCGDEV, &mine) == 0 && ::ioctl(device, TIOCGDEV, &other) == 0 &&
         mine == other;
}

// TIOCEXCL keeps out programs that open the device later; flock also finds those that lock it.
void claim(int device, const std::string& path) {
  if (::isatty(device) == 0) {
    refuse_device(path, "no serial device and no pseudo-terminal");
  }
  if (is_same_terminal(device)) {
    refuse_device(path, "this is the terminal on which xr3 runs");
  }
  if (::flock(device, LOCK_EX | LOCK_NB) != 0) {
    refuse_used(path);
  }
  ::ioctl(device, TIOCEXCL);
}

tcflag_t bits_of_frame(const SerialFrame& frame) {
  constexpr std::array<tcflag_t, 4> kSizes = {CS5, CS6, CS7, CS8};
  tcflag_t bits = kSizes.at(static_cast<std::size_t>(frame.data_bits - kMinDataBits));
  if (frame.stop_bits != StopBits::kOne) bits |= CSTOPB;
  switch (frame.parity) {
    case Parity::kNone: break;
    case Parity::kOdd: bits |= PARENB | PARODD; break;
    case Parity::kEven: bits |= PARENB; break;
    case Parity::kMark: bits |= PARENB | PARODD | CMSPAR; break;
    case Parity::kSpace: bits |= PARENB | CMSPAR; break;
  }
  if (frame.flow == FlowControl::kHardware) bits |= CRTSCTS;
  return bits;
}

// Whether the error only says that a pseudo-terminal has no frame. The C library of Debian refuses
// one with EINVAL, but only in a request that changes nothing else, such as that of the second
// program on it.
bool is_without_frame(int device, int error) {
  constexpr unsigned kFirstPtsMajor = 136;
  constexpr unsigned kLastPtsMajor = 143;
  struct stat status {};
  if (error != EINVAL || ::fstat(device, &status) != 0) return false;
  return major(status.st_rdev) >= kFirstPtsMajor && major(status.st_rdev) <= kLastPtsMajor;
}

// Without HUPCL, DTR stays on at the end: a controller that watches it is not reset.
void set_up(int device, const std::string& path, const SerialSettings& settings) {
  const auto speed = speeds().find(settings.baud);
  if (speed == speeds().end()) {
    refuse_device(path, "no device has " + std::to_string(settings.baud) + " baud; 9600 is usual");
  }
  termios state{};
  if (::tcgetattr(device, &state) != 0) refuse_open(path, errno);
  const SerialFrame frame = settings.frame.value_or(SerialFrame{});
  ::cfmakeraw(&state);
  constexpr tcflag_t kFrame = CSIZE | CSTOPB | PARENB | PARODD | CMSPAR | CRTSCTS | HUPCL;
  state.c_cflag = (state.c_cflag & ~kFrame) | bits_of_frame(frame) | CLOCAL | CREAD;
  constexpr tcflag_t kSoftwareFlow = IXON | IXOFF;
  state.c_iflag &= ~(kSoftwareFlow | IXANY);
  if (frame.flow == FlowControl::kSoftware) state.c_iflag |= kSoftwareFlow;
  ::cfsetispeed(&state, speed->second);
  ::cfsetospeed(&state, speed->second);
  if (::tcsetattr(device, TCSANOW, &state) != 0 && !is_without_frame(device, errno)) {
    refuse_open(path, errno);
  }
}

}  // namespace

int open_serial_device(const std::string& path, const SerialSettings& settings) {
  Descriptor device(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!device.is_open()) refuse_open(path, errno);
  claim(device.get(), path);
  set_up(device.get(), path, settings);
  return device.release();
}

void discard_all(int device) { ::tcflush(device, TCIOFLUSH); }

void discard_output(int device) { ::tcflush(device, TCOFLUSH); }

}  // namespace xr3
