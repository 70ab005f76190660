// Serial ports of this machine: opened raw, and for this process alone.
#pragma once

#include <string>

#include "protocol/line/serial_settings.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {

/// A serial device cannot be opened; the message names it and the reason.
class SerialDeviceError : public FileError {
 public:
  SerialDeviceError(const std::string& message, bool is_in_use)
      : FileError(message), is_in_use_(is_in_use) {}
  /// Whether another program has the device.
  bool is_in_use() const { return is_in_use_; }

 private:
  bool is_in_use_;
};

/// Opens a serial device or the slave of a pseudo-terminal, non-blocking. Programs that lock ports
/// are excluded, and those that open the device later; a plain holder cannot be detected. Modem
/// lines keep their state when the descriptor is closed. The default frame is that of a Mark III.
/// Returns the descriptor, which the caller owns. Throws SerialDeviceError.
int open_serial_device(const std::string& path, const SerialSettings& settings);

/// Discards bytes of both directions that the system holds.
void discard_all(int device);
/// Discards bytes that were written and not yet sent.
void discard_output(int device);

}  // namespace xr3
