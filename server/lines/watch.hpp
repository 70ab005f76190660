// Reports the robot lines with new events: one edge-triggered epoll set for all lines, which the
// event loop watches as one descriptor. A line is reported once for each arrival and each time it
// becomes writable again, so the caller must read everything, or remember that there is more.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <span>

#include "server/net/asio.hpp"

namespace xr3 {

/// Numbers the sessions of all cells while they are open; a line's own number counts per cell.
using SessionNumber = std::uint32_t;

class LineWatch {
 public:
  /// A line has received bytes, has become writable, or has ended.
  struct WatchEvent {
    SessionNumber session = 0;
    bool is_end = false;   ///< end of stream or broken connection: read to the end
    bool is_loss = false;  ///< broken connection
  };

  /// Throws boost::system::system_error if no descriptor is left.
  explicit LineWatch(asio::io_context& io);
  LineWatch(const LineWatch&) = delete;
  LineWatch& operator=(const LineWatch&) = delete;

  /// Adds a descriptor. Events before this call are reported, too. Closing the descriptor removes
  /// it. Returns false if the system refuses.
  bool add(int descriptor, SessionNumber session);

  /// Waits for events. Returns false if closed. Throws boost::system::system_error.
  asio::awaitable<bool> wait();
  void close();
  bool is_open() const { return set_.is_open(); }

  /// The events now, at most kMaxEvents; may be empty. Valid until the next call.
  std::span<const WatchEvent> poll();
  static constexpr std::size_t kMaxEvents = 1024;

 private:
  asio::posix::stream_descriptor set_;
  std::array<epoll_event, kMaxEvents> events_{};
  std::array<WatchEvent, kMaxEvents> reported_{};
};

}  // namespace xr3
