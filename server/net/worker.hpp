// A thread for pure work that takes longer than other clients may wait: encoding large pictures and
// texts, and parsing large requests. The work gets copies or constant data, never the cell. The
// thread starts with the first work: a server that has only lines stays a process of one thread,
// whose system calls, locks and shared pointers cost less.
#pragma once

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/thread_pool.hpp>
#include <optional>
#include <utility>

#include "server/net/asio.hpp"

namespace xr3 {

class Worker {
 public:
  Worker() = default;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() { stop(); }

  /// Calls `work` in the thread, after all work that was begun before; resumes with its result or
  /// its exception in the caller's event loop. What `work` refers to must exist until then. The
  /// thread has a lower priority than the event loop's. If the system refuses to start it, the work
  /// is done in the event loop. To be called by one thread only.
  template <class Work>
  asio::awaitable<std::invoke_result_t<Work>> run(Work work) {
    if (!start()) co_return work();
    const auto call = [](Work kept) -> asio::awaitable<std::invoke_result_t<Work>> {
      co_return kept();
    };
    co_return co_await asio::co_spawn(*thread_, call(std::move(work)), asio::use_awaitable);
  }

  /// Waits for the work that runs now and drops the rest: the coroutines that wait for it are
  /// destroyed, so what they refer to must still exist. For the end of the process.
  void stop();

 private:
  /// Makes shutdown() public, which destroys waiting handlers.
  class Thread : public asio::thread_pool {
   public:
    Thread() : asio::thread_pool(1) {}
    using asio::thread_pool::shutdown;
  };

  /// Returns whether the thread runs.
  bool start();

  std::optional<Thread> thread_;  ///< nullopt before the first work
};

}  // namespace xr3
