#include "server/device/uucp_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "server/device/serial_device.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {
namespace {

/// The process in a lock file; 0 if there is none.
::pid_t owner_in(const std::string& file) {
  const Descriptor lock(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (!lock.is_open()) return 0;
  std::array<char, 16> text{};
  const auto size = ::read(lock.get(), text.data(), text.size() - 1);
  return size <= 0 ? 0 : static_cast<::pid_t>(std::strtol(text.data(), nullptr, 10));
}

bool is_alive(::pid_t process) {
  return process > 0 && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

UucpLock::UucpLock(const std::string& device, const std::filesystem::path& folder) {
  std::error_code error;
  const auto port = std::filesystem::canonical(device, error);
  if (error || port.parent_path() != "/dev") return;
  file_ = folder / ("LCK.." + port.filename().string());
  if (create()) return;
  if (errno != EEXIST) {
    file_.clear();
    return;
  }
  const ::pid_t owner = owner_in(file_);
  if (is_alive(owner)) {
    const std::string lock = std::exchange(file_, "");
    throw SerialDeviceError(
        device + ": in use by process " + std::to_string(owner) + " (" + lock + ")", true);
  }
  ::unlink(file_.c_str());
  if (!create()) file_.clear();
}

UucpLock::~UucpLock() {
  if (!file_.empty() && owner_in(file_) == ::getpid()) ::unlink(file_.c_str());
}

// Creates the lock file: ten digits and a newline, as all these programs write it.
bool UucpLock::create() const {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  constexpr ::mode_t kForAll = 0644;
  const Descriptor lock(::open(file_.c_str(), kFlags, kForAll));
  if (!lock.is_open()) return false;
  std::array<char, 16> text{};
  const int size = std::snprintf(text.data(), text.size(), "%10d\n", ::getpid());
  const bool is_written = write_all(lock.get(), {text.data(), static_cast<std::size_t>(size)});
  if (!is_written) ::unlink(file_.c_str());
  return is_written;
}

}  // namespace xr3
