// A pseudo-terminal at a path, and the thread that polls it. poll() of a terminal waits for the
// worker of the kernel that hands on its bytes. A program that opens and closes its terminal, or
// changes its modes, without end keeps this worker busy for milliseconds. So the event loop never
// polls a terminal. A thread does it, one for each terminal.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "server/files/descriptor.hpp"
#include "server/net/wall_clock.hpp"
#include "server/pty/place.hpp"
#include "server/pty/signal.hpp"

namespace xr3 {

class PtyWatch {
 public:
  /// Makes a pseudo-terminal at the path, whose slave has these rights, and starts the thread.
  /// Throws FileError.
  PtyWatch(const std::string& path, ::mode_t rights);
  PtyWatch(const PtyWatch&) = delete;
  PtyWatch& operator=(const PtyWatch&) = delete;
  /// Ends the thread, then removes the terminal.
  ~PtyWatch();

  PtyPlace& place() { return place_; }
  const PtyPlace& place() const { return place_; }

  /// The thread polls soon.
  void poll_soon() const { requests_.give(); }
  /// The same, with news at the end. Returns the number of this round.
  std::uint64_t begin_round();
  /// What programs did before the round began is known: whether they have come or gone, and their
  /// bytes, as far as the terminal shows them at once.
  bool has_ended(std::uint64_t round) const { return ended_ >= round; }
  /// The thread polls when there is room for bytes to the program, once. (Each write would wake it
  /// if it always did.)
  void await_room();

  /// Given when a program has arrived, when the place has failed or no longer has, when a round has
  /// ended, and when the thread has failed.
  const Signal& news() const { return news_; }
  /// The errno with which the thread has ended. 0: it runs.
  int error() const { return error_; }

 private:
  void watch(const PseudoTerminal& terminal) const;
  bool control(int how, int descriptor, std::uint32_t events) const;
  void run();
  void wait();
  void update();
  bool take_opens() const;
  void poll();
  bool is_renewal_due() const;
  void renew();

  const ::mode_t rights_;
  Descriptor set_;    ///< epoll
  Descriptor opens_;  ///< inotify: a program has opened the slave
  Signal requests_;
  Signal news_;
  PtyPlace place_;
  WallNs retry_at_ = kNever;  ///< while the place has failed
  std::atomic<std::uint64_t> begun_ = 0;
  std::atomic<std::uint64_t> ended_ = 0;
  std::atomic<bool> is_room_requested_ = false;
  std::atomic<int> error_ = 0;
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;
};

}  // namespace xr3
