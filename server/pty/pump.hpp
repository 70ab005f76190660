// The owner of a pseudo-terminal: a thread that moves bytes between the terminal and a socket pair.
//
// The flow through the folder: a program opens the terminal (pseudo_terminal.hpp) by its link
// (link.hpp), which inotify reports to the thread. The thread makes a socket pair, keeps one end
// and shares the other (`PtyShared::line`), which the event loop accepts as a line (port.hpp,
// stream.hpp). Then it moves bytes in both directions until one side ends. If the last program
// closes the terminal, the thread moves the rest of its bytes, makes the terminal ready for the
// next program, and shuts its end of the pair down for writing; the event loop reads to the end and
// closes the line, and replies are discarded meanwhile. If the event loop closes its end, since the
// server has ended the line, the thread replaces the terminal, so that its programs see a hangup.
// Only the thread polls, reads and writes the terminal: these calls wait for a worker of the
// kernel, which a program that opens, closes or sets its terminal without end keeps busy.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "server/files/descriptor.hpp"
#include "server/pty/link.hpp"
#include "server/pty/pseudo_terminal.hpp"
#include "server/pty/shared.hpp"

namespace xr3 {

class PtyPump {
 public:
  /// Makes a terminal, whose slave has these rights, and the link to it at the path; starts the
  /// thread. The thread calls `notify` when the shared state has changed, but not for `changes`; a
  /// second later again if it throws std::bad_alloc. Throws FileError.
  PtyPump(const std::string& path, ::mode_t rights, std::function<void()> notify);
  PtyPump(const PtyPump&) = delete;
  PtyPump& operator=(const PtyPump&) = delete;
  /// Waits for the end of the thread, which is that of its line, then removes terminal and link.
  ~PtyPump();

  const std::string& path() const { return link_.path(); }
  PtyShared& shared() { return shared_; }

  /// Begins no further line and no further round; the thread ends when its line has ended.
  void close();
  /// Begins a round of the thread, which moves bytes that programs have written before, at most
  /// kPtyRound of them and what the socket pair takes, and notices programs that have come and
  /// gone. Returns the value of `rounds_ended` when it has ended.
  std::uint64_t begin_round();

 private:
  /// Bytes under way in one direction.
  class Flow {
   public:
    bool is_empty() const { return begin_ == end_; }
    void clear() { begin_ = end_ = 0; }
    /// Reads some if it is empty. Returns the number of bytes in it, or the result of read().
    ::ssize_t fill(int from);
    /// Writes as many as are taken.
    void drain(int to);

   private:
    std::array<char, kPtyRound> bytes_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
  };

  // --- The thread.
  void run();
  void wait();
  std::exception_ptr work();
  bool report(std::exception_ptr failure);
  void notify();
  void pass();
  bool is_closing();
  void find_program();
  bool is_program_there() const;
  bool drain_opens() const;
  void begin_line();
  void serve();
  bool move_replies();
  void move_bytes(bool has_bytes);
  void record_settings();
  void leave();
  void await_end();
  void end_line(bool is_spoilt);
  void prepare();
  void renew();
  void watch(const PseudoTerminal& terminal) const;
  void wake() const;

  const ::mode_t rights_;
  const std::function<void()> notify_;
  Descriptor opens_;  ///< inotify: a program has opened the slave
  Descriptor wake_;   ///< eventfd
  PtyShared shared_;
  std::uint64_t rounds_begun_ = 0;

  // --- Of the thread.
  PseudoTerminal terminal_;
  PtyLink link_;
  Descriptor line_;  ///< the thread's end of the socket pair; closed: no line is served
  Flow bytes_;
  Flow replies_;
  std::uint64_t round_ = 0;    ///< begun before the pass
  PtyModes modes_;             ///< modes of the last byte
  std::uint64_t offset_ = 0;   ///< offset of the next byte
  bool is_open_ = false;       ///< a program has the terminal open
  bool is_leaving_ = false;    ///< no more bytes come for the line, which ends
  bool is_line_over_ = false;  ///< the event loop has closed its end
  bool is_spoilt_ = false;     ///< the terminal must be replaced when the line has ended
  bool has_failed_ = false;    ///< the last pass
  bool must_notify_ = false;   ///< `notify` is to be called

  std::thread thread_;
};

}  // namespace xr3
