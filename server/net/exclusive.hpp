// Mutual exclusion of coroutines of one event loop: one holds the mutex, the others wait.
#pragma once

#include <cassert>

#include "server/net/asio.hpp"

namespace xr3 {

class Exclusive {
 public:
  explicit Exclusive(asio::io_context& io) : freed_(io, asio::steady_timer::time_point::max()) {}
  Exclusive(const Exclusive&) = delete;
  Exclusive& operator=(const Exclusive&) = delete;

  bool is_held() const { return is_held_; }

  /// Waits until free, FIFO: if the caller takes hold at once, the next one continues to wait.
  asio::awaitable<void> until_free();

  /// Holds the mutex during its lifetime.
  class Hold {
   public:
    /// Precondition: !is_held().
    explicit Hold(Exclusive& exclusive) : exclusive_(exclusive) {
      assert(!exclusive_.is_held_);
      exclusive_.is_held_ = true;
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() {  // NOLINT(bugprone-exception-escape): cancelling a timer does not fail
      exclusive_.is_held_ = false;
      exclusive_.freed_.cancel();
    }

   private:
    Exclusive& exclusive_;
  };

 private:
  asio::steady_timer freed_;  ///< never expires; cancelled to resume waiting coroutines
  bool is_held_ = false;
};

}  // namespace xr3
