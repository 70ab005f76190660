// A pseudo-terminal: this process has its master side, and one program at a time, or several, open
// the slave side, which looks like a serial port.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "server/files/descriptor.hpp"

namespace xr3 {

/// The settings of a program on the slave side, without the frame, which the driver drops.
struct PtyModes {
  std::uint32_t baud = 0;
  bool is_cooked = false;  ///< echoes or edits lines, so that replies return as commands

  bool operator==(const PtyModes&) const = default;
};

class PseudoTerminal {
 public:
  /// Makes a pseudo-terminal whose slave has these rights, ready for a program. Throws FileError.
  explicit PseudoTerminal(::mode_t rights);

  int master() const { return master_.get(); }
  /// The path of the slave, such as /dev/pts/3.
  const std::string& slave() const { return slave_; }

  struct TerminalState {
    bool is_open;    ///< a program has the slave open
    bool has_bytes;  ///< a read would give bytes
  };
  /// Waits until the kernel has handed on the bytes that programs have written, which takes long if
  /// the system is busy. If the terminal cannot be polled, nothing has changed: it is open.
  TerminalState poll() const;
  /// Makes the slave as a program expects a serial port: raw, 9600 baud, neither stopped nor
  /// exclusive, and without replies that the last program has not read. Bytes from a program are
  /// kept. Throws FileError, also if the last program has left another line discipline.
  void prepare() const;
  PtyModes modes() const;

 private:
  Descriptor master_;
  std::string slave_;
};

}  // namespace xr3
