// The origin of serial lines: the robot port, or the pseudo-terminals.
#pragma once

#include "cell/counters.hpp"
#include "protocol/explain/cell_event.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class LineSource {
 public:
  /// Waits until the bytes that clients have sent before this call can be read, and applies those
  /// that must be read before the rest can.
  virtual asio::awaitable<void> settle() { co_return; }
  /// Opens a line for each client that has arrived, without waiting.
  virtual void accept_arrived() = 0;
  /// Called after bytes of one of its lines were executed.
  virtual void line_executed(LineId /*line*/) {}
  /// Called at the end of one of its lines.
  virtual void line_ended(LineId line, LineCloseReason reason) = 0;
  /// Clients that got no line.
  virtual PortCounters counters() const { return {}; }

 protected:
  ~LineSource() = default;  // never owned through this interface
};

}  // namespace xr3
