// Interface of the transports of monitor sessions: JSON lines and WebSocket.
#pragma once

#include "server/net/prefetch.hpp"

namespace xr3 {

class MessageSink {
 public:
  virtual ~MessageSink() = default;

  /// Called when there is output. Fetches it with next_output(), now or when the connection is
  /// writable.
  virtual void pump() = 0;

  /// Prefetches the memory that a following pump() will access at this depth.
  virtual void prefetch(Depth depth) const = 0;
};

}  // namespace xr3
