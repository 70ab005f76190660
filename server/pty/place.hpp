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
    kLeft,     ///< all programs have closed it, and their bytes have been read
    kDropped,  ///< it has to be replaced: the server has ended the line, or it cannot be made ready
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
  /// The line has ended. `is_dropped`: the server ended it; its program may still be there.
  void end_line(bool is_dropped);

  /// Held while the line uses the terminal. If the thread holds it, the line has news later.
  std::unique_lock<std::mutex> try_use() { return std::unique_lock(use_, std::try_to_lock); }
  /// For an edge-triggered set: it has an event each time the line has news.
  int news_descriptor() const { return news_.descriptor(); }
  /// No program has the terminal open, but there may be bytes to read.
  bool is_leaving() const { return is_leaving_; }
  /// Whether a write may take a byte since the last call.
  bool take_room() { return has_room_.exchange(false); }
  /// Why the place has failed last. Precondition: it has.
  std::string failure() const;

  // --- For the thread.

  /// A program has opened the terminal, and may have closed it again.
  void note_opened() { was_opened_ = true; }
  /// Polls the terminal, which waits for the kernel, and enters the stage that follows. Returns
  /// whether it has opened the terminal itself, to make it ready.
  bool poll();
  /// Gives the place another terminal. Precondition: kDropped or kFailed. Throws FileError.
  void replace(PseudoTerminal fresh);
  /// kFailed with the exception that is being handled. Precondition: that of replace().
  void fail();

 private:
  bool look_for_program();
  bool report_to_line();
  bool try_to_leave(PseudoTerminal::State& state);
  bool try_to_prepare();

  PseudoTerminal terminal_;
  PtyLink link_;
  Signal news_;
  std::atomic<Stage> stage_ = Stage::kIdle;
  std::atomic<bool> is_leaving_ = false;
  std::atomic<bool> has_room_ = false;
  std::mutex use_;           ///< the thread makes the terminal ready, or the line reads or writes
  bool is_unready_ = false;  ///< written before kLeft: it could not be made ready
  bool was_opened_ = false;  ///< of the thread: since it was made ready
  mutable std::mutex failure_use_;
  std::exception_ptr failure_;
};

}  // namespace xr3
