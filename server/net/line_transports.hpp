// The transports of the serial lines, in the form that the monitor's calls need.
#pragma once

#include <chrono>
#include <cstdint>

#include "cell/counters.hpp"
#include "protocol/explain/cell_event.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class LineTransports {
 public:
  /// Applies every byte that has already arrived, including those of connections that are not
  /// accepted yet, as long as the line's replies can be sent. `step` and `run_until` call it first,
  /// so that bytes sent before them are executed before them. Other handlers run meanwhile if it
  /// takes long.
  virtual asio::awaitable<void> read_arrived() = 0;

  /// Runs turns of lines that wait for one, for a fraction of a millisecond. It is cheap enough to
  /// be called between writes to monitor sessions: a line never waits for a thousand of them.
  virtual void run_turns() = 0;

  /// Resumes when other handlers have run, callers in order. So others wait for one piece of work
  /// at a time, however many callers work in pieces.
  virtual asio::awaitable<void> pause() = 0;

  /// Waits until a line has received `bytes_in` bytes in total. Returns false if the time is over,
  /// the line has closed before, or the transports are closing.
  virtual asio::awaitable<bool> wait_for_bytes(LineId line, std::uint64_t bytes_in,
                                               std::chrono::milliseconds within) = 0;

  /// Closes the connection of a line. Returns false if it belongs to no transport.
  virtual bool disconnect(LineId line) = 0;

  virtual PortCounters counters() const = 0;

 protected:
  ~LineTransports() = default;  // never owned through this interface
};

}  // namespace xr3
