// Hears of the bytes of data on the serial lines: as each acts, before each command, and as each
// reply leaves. The byte clock lets time pass then, and the transcript records the bytes. Bytes
// that the detector or the telnet filter keeps, and those of telnet itself, are not heard of.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/command.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3 {

class LineListener {
 public:
  /// A byte is about to act. Time may pass, and a fault may cut the line in that time.
  virtual void byte_comes(LineId line, std::uint8_t byte) = 0;
  /// A command is about to be executed. Time may pass as in byte_comes().
  virtual void command_comes(LineId line, const Command& command) = 0;
  /// Bytes of replies have gone to the outbox; they are given as they were before the telnet
  /// filter. No time passes.
  virtual void reply_leaves(LineId line, std::string_view reply) = 0;

 protected:
  ~LineListener() = default;  // never owned through this interface
};

}  // namespace xr3
