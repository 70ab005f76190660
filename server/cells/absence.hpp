// The time in which a cell is not there yet, since its recording is being repeated: nothing may
// reach it. A request that needs the cell waits here, and its turn comes earlier.
#pragma once

#include <functional>
#include <utility>

#include "server/net/asio.hpp"

namespace xr3 {

class Absence {
 public:
  /// `wanted` is called whenever a client begins to wait. It must not end the absence at once.
  Absence(asio::io_context& io, std::function<void()> wanted)
      : wanted_(std::move(wanted)), over_(io, asio::steady_timer::time_point::max()) {}

  void want() const { wanted_(); }
  /// Waits for the end.
  asio::awaitable<void> wait() {
    wanted_();
    co_await over_.async_wait(kAwait);
  }
  /// Resumes all who wait.
  void end() { over_.cancel(); }

 private:
  std::function<void()> wanted_;
  asio::steady_timer over_;
};

}  // namespace xr3
