// Interface of the transports of monitor sessions: JSON lines and WebSocket.
#pragma once

namespace xr3 {

class MessageSink {
 public:
  virtual ~MessageSink() = default;

  /// Called when there is output. Fetches it with next_output(), now or when the connection is
  /// writable.
  virtual void pump() = 0;
};

}  // namespace xr3
