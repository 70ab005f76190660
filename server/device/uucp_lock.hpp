// The lock file by which programs for serial ports, such as minicom, exclude each other from a
// port: `LCK..ttyUSB0` with the number of the process that uses it.
#pragma once

#include <filesystem>
#include <string>

namespace xr3 {

class UucpLock {
 public:
  /// Locks a device. Takes over the lock of a process that has ended. Throws SerialDeviceError if
  /// another process has the device. Without effect if this user may not write to the folder, as is
  /// usual, and for pseudo-terminals.
  explicit UucpLock(const std::string& device, const std::filesystem::path& folder = "/var/lock");
  UucpLock(const UucpLock&) = delete;
  UucpLock& operator=(const UucpLock&) = delete;
  ~UucpLock();

 private:
  bool create() const;

  std::string file_;  ///< empty if nothing is locked
};

}  // namespace xr3
