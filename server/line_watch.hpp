// Tells on which robot lines bytes have arrived, by one short system call and without a turn of the event
// loop: an edge-triggered epoll set beside Asio's own. A line is told once for each arrival; nothing is
// lost if nobody asks, since the loop reads every line by itself.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <span>

#include "protocol/cell_event.hpp"

namespace xr3 {

class LineWatch {
 public:
  LineWatch();
  LineWatch(const LineWatch&) = delete;
  LineWatch& operator=(const LineWatch&) = delete;
  ~LineWatch();

  /// The descriptor leaves the set by itself when it is closed.
  void add(int descriptor, LineId line);

  /// Lines with news since they were told last, at most 16; valid until the next call.
  std::span<const LineId> news();

 private:
  static constexpr int kMostNews = 16;

  int epoll_;
  std::array<epoll_event, kMostNews> events_{};
  std::array<LineId, kMostNews> lines_{};
};

}  // namespace xr3
