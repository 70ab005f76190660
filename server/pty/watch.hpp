// The thread that attends to pseudo-terminals. poll() of a terminal waits for the worker of the
// kernel that hands on its bytes. A program that opens and closes its terminal, or changes its
// modes, without end keeps this worker busy for milliseconds, so the event loop never polls one.
#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "server/files/descriptor.hpp"
#include "server/net/wall_clock.hpp"
#include "server/pty/place.hpp"
#include "server/pty/signal.hpp"

namespace xr3 {

class PtyWatch {
 public:
  /// Makes a pseudo-terminal at each path, whose slave has these rights, and starts the thread.
  /// Throws FileError.
  PtyWatch(const std::vector<std::string>& paths, ::mode_t rights);
  PtyWatch(const PtyWatch&) = delete;
  PtyWatch& operator=(const PtyWatch&) = delete;
  /// Ends the thread, then removes the terminals.
  ~PtyWatch();

  std::list<PtyPlace>& places() { return places_; }

  /// Attends to the place soon.
  void attend(PtyPlace& place);
  /// Attends to all places soon. Returns the number of this round.
  std::uint64_t attend_to_all();
  /// Whether a round has ended. What programs had written when it was requested can be read then.
  bool has_attended(std::uint64_t round) const { return attended_ >= round; }
  /// Attends to the place when there is room for bytes to its program, once. (If it always did, it
  /// would do so after each write.)
  void await_room(PtyPlace& place);

  /// Given when a program has arrived, when a place has failed or is served again, when a round has
  /// ended, and when the thread has failed.
  const Signal& news() const { return news_; }
  /// The errno of the thread. 0: it runs.
  int failure() const { return failure_; }

 private:
  void watch(PtyPlace& place);
  /// Watches a descriptor. `place`: nullptr for those of the watch itself.
  bool control(int how, int descriptor, std::uint32_t events, PtyPlace* place) const;
  void run();
  void wait();
  void retry();
  void take_own_events();
  void answer(PtyPlace& place);
  void handle(PtyPlace& place, std::uint32_t events);
  void move_on(PtyPlace& place);
  void renew(PtyPlace& place);

  Descriptor set_;    ///< epoll
  Descriptor opens_;  ///< inotify: a program has opened a slave
  Signal requests_;
  Signal news_;
  std::list<PtyPlace> places_;
  WallNs retry_at_ = kNever;  ///< of places that have failed
  std::atomic<std::uint64_t> requested_ = 0;
  std::atomic<std::uint64_t> attended_ = 0;
  std::atomic<int> failure_ = 0;
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;
};

}  // namespace xr3
