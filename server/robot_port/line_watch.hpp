// Tells at which robot lines something has happened: one edge-triggered epoll set for all of them, which
// the event loop watches as one. A line is told once for each arrival and each time that it can be
// written to again, so whoever is told reads all that there is, or remembers that there is more.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <span>

#include "protocol/explain/cell_event.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class LineWatch {
 public:
  /// Something has happened at a line.
  struct News {
    LineId line = 0;
    bool is_end = false;  ///< its client sends no more, or it is broken: read to the end
  };

  /// Throws boost::system::system_error where no descriptor is left.
  explicit LineWatch(asio::io_context& io);
  LineWatch(const LineWatch&) = delete;
  LineWatch& operator=(const LineWatch&) = delete;

  /// What has happened by now is news. The descriptor leaves the set by itself when it is closed.
  /// False: the system has no room for it.
  bool add(int descriptor, LineId line);

  /// Waits until there are news. False: it was closed. Throws boost::system::system_error.
  asio::awaitable<bool> wait();
  void close();

  /// At most kMaxNews; empty: there are none. Valid until the next call.
  std::span<const News> news();
  static constexpr std::size_t kMaxNews = 128;

 private:
  asio::posix::stream_descriptor set_;
  std::array<epoll_event, kMaxNews> events_{};
  std::array<News, kMaxNews> news_{};
};

}  // namespace xr3
