// The path of a pseudo-terminal and the terminal that it has now. A thread (`watch`) finds the
// programs that come and go, and makes the terminal ready for the next one. The event loop serves
// a program while it is there. The stage says what happens now.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>

#include "server/pty/link.hpp"
#include "server/pty/pseudo_terminal.hpp"
#include "server/pty/signal.hpp"

namespace xr3 {

class PtyPlace {
 public:
  enum class Stage : std::uint8_t {
    kIdle,     ///< no program has the terminal open
    kArrived,  ///< a program has opened it, and may have closed it again
    kServed,   ///< a line reads and writes
    kLeft,     ///< all have closed it, their bytes are read, and it is ready for the next program
    kDropped,  ///< the server has ended the line: the terminal has to be replaced
    kFailed,   ///< the terminal could not be replaced: nothing is served until it can
  };

  /// Makes a terminal, whose slave has these rights, and the link to it. Throws FileError.
  PtyPlace(const std::string& path, ::mode_t rights);

  const std::string& path() const { return link_.path(); }
  Stage stage() const { return stage_; }
  const PseudoTerminal& terminal() const { return terminal_; }

  // --- For the event loop.

  /// A line begins. Precondition: kArrived.
  void begin_line();
  /// The line has ended. `is_dropped`: although its program may be there.
  void end_line(bool is_dropped);

  /// Held while the line uses the terminal. If the thread holds it, the line has news later.
  std::unique_lock<std::mutex> try_use() { return std::unique_lock(use_, std::try_to_lock); }
  /// For an edge-triggered set: it has an event each time the line has news.
  int news() const { return news_.descriptor(); }
  /// No program has the terminal open, but there may be bytes to read.
  bool is_leaving() const { return is_leaving_; }
  /// Whether a write may take a byte since the last call.
  bool take_room() { return has_room_.exchange(false); }
  /// The thread attends to the place when it takes the request.
  void request() { is_requested_ = true; }
  /// The thread attends to it when there is room for bytes to the program.
  void request_room() { is_room_requested_ = true; }
  /// The reason of kFailed.
  std::string failure() const;

  // --- For the thread.

  bool take_request() { return is_requested_.exchange(false); }
  bool take_room_request() { return is_room_requested_.exchange(false); }

  /// Polls the terminal, which waits for the kernel, and enters the stage that follows.
  void attend();
  /// Replaces the terminal. Precondition: kDropped or kFailed. Throws FileError.
  void renew();
  /// kFailed with the exception that is being handled. Precondition: that of renew().
  void fail();

 private:
  void follow(const PseudoTerminal::State& state);
  void make_ready();

  const ::mode_t rights_;
  PseudoTerminal terminal_;
  PtyLink link_;
  Signal news_;
  std::atomic<Stage> stage_ = Stage::kIdle;
  std::atomic<bool> is_leaving_ = false;
  std::atomic<bool> has_room_ = false;
  std::atomic<bool> is_requested_ = false;
  std::atomic<bool> is_room_requested_ = false;
  std::mutex use_;           ///< the thread makes the terminal ready, or the line reads or writes
  bool is_unready_ = false;  ///< written before kLeft: it could not be made ready
  std::exception_ptr failure_;  ///< written before kFailed
};

}  // namespace xr3
