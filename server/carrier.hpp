// What carries a viewer's messages: JSON lines or a WebSocket, as the viewer and the audience see it.
#pragma once

#include "server/prefetch.hpp"

namespace xr3 {

class Carrier {
 public:
  virtual ~Carrier() = default;

  /// There is output: takes it by next_output(), now or when the connection is writable.
  virtual void pump() = 0;

  /// pump() will come soon: brings what it will touch, the first pointer's and then the second's.
  virtual void prefetch(Depth depth) const = 0;
};

}  // namespace xr3
