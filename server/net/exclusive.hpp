// Mutual exclusion of coroutines of one event loop: one holds it, the others wait.
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

  /// Resumes when nobody holds it, those that wait one after the other: if the caller takes hold of
  /// it at once, the next one goes on waiting.
  asio::awaitable<void> until_free();

  /// Holds it as long as it exists. Precondition: nobody else does.
  class Hold {
   public:
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
  asio::steady_timer freed_;  ///< never expires; cancelled to resume those that wait
  bool is_held_ = false;
};

}  // namespace xr3
