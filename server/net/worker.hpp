// A thread for pure work that takes longer than other clients may wait: compressing pictures,
// parsing long requests, and simulating a moment of the past. The work gets copies or constant
// data, never the cell.
#pragma once

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/thread_pool.hpp>
#include <utility>

#include "server/net/asio.hpp"

namespace xr3 {

class Worker {
 public:
  /// Starts the thread, with a lower priority than the event loop's. Throws
  /// boost::system::system_error if the system refuses.
  Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() { stop(); }

  /// Calls `work` in the thread, after all work that was begun before; resumes with its result or
  /// its exception in the caller's event loop. Data that `work` refers to must exist until then.
  /// The thread has a lower priority than the event loop's. Call from one
  /// thread only.
  template <class Work>
  asio::awaitable<std::invoke_result_t<Work>> run(Work work) {
    const auto call = [](Work kept) -> asio::awaitable<std::invoke_result_t<Work>> {
      co_return kept();
    };
    co_return co_await asio::co_spawn(thread_, call(std::move(work)), asio::use_awaitable);
  }

  /// Waits for the running work and drops the rest: the coroutines that wait for it are destroyed,
  /// so data that they refer to must still exist. For the end of the process.
  void stop();

 private:
  /// Makes shutdown() public, which destroys waiting handlers.
  class Thread : public asio::thread_pool {
   public:
    Thread() : asio::thread_pool(1) {}
    using asio::thread_pool::shutdown;
  };

  Thread thread_;
};

}  // namespace xr3
