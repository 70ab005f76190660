// The serial port of a physical controller: opened raw and for this process alone.
#pragma once

#include <string>

#include "protocol/line/serial_settings.hpp"

namespace xr3 {

/// Opens a serial port, non-blocking, and discards what the system holds of both directions. Other
/// programs that lock ports are kept away; a plain holder cannot be detected. Modem lines are left
/// as they are when the descriptor is closed. Returns the descriptor, which the caller owns. Throws
/// FileError.
int open_serial_device(const std::string& path, const SerialSettings& settings);

/// Discards bytes that were written and have not left.
void discard_output(int descriptor);

}  // namespace xr3
