// The bytes of one serial line outside the process, with non-blocking I/O: a TCP connection or a
// pseudo-terminal. It is not an Asio object: the event loop would watch each one, and watching a
// thousand lines together is cheaper (`watch`).
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "cell/input.hpp"

namespace xr3 {

class LineStream {
 public:
  LineStream() = default;
  LineStream(const LineStream&) = delete;
  LineStream& operator=(const LineStream&) = delete;
  virtual ~LineStream() = default;

  /// Negative after close().
  virtual int descriptor() const = 0;
  bool is_open() const { return descriptor() >= 0; }

  /// The number of bytes read. 0: none now, or none any more if has_ended() or is_lost().
  virtual std::size_t read(std::span<char> into) = 0;
  /// The number of bytes written. 0: none now, or is_lost().
  virtual std::size_t write(std::string_view bytes) = 0;
  virtual void close() = 0;
  /// The number of bytes that have arrived and can be read now, as the system reports it for the
  /// descriptor. Precondition: the stream is open.
  virtual std::size_t unread_bytes() const;

  /// To be called when all bytes read were executed: acknowledges them to the client, unless a
  /// reply has done so.
  virtual void acknowledge() {}

  /// The maximum number of bytes that a read barrier reads after LineSource::settle(), or after one
  /// round of it: more have been sent later.
  virtual std::size_t max_settled() const { return std::numeric_limits<std::size_t>::max(); }

  /// The settings of the serial port if they have changed since the last call, as an input for
  /// this line.
  virtual std::optional<LineSettings> changed_settings(LineId) { return std::nullopt; }

  /// The last read has left bytes, although it gave fewer than were wanted: their settings differ.
  bool has_more() const { return has_more_; }
  /// The client sends no more bytes.
  bool has_ended() const { return has_ended_; }
  /// The connection is broken.
  bool is_lost() const { return is_lost_; }

 protected:
  void set_has_more(bool has_more) { has_more_ = has_more; }
  void set_ended() { has_ended_ = true; }
  void set_lost() { is_lost_ = true; }

 private:
  bool has_more_ = false;
  bool has_ended_ = false;
  bool is_lost_ = false;
};

}  // namespace xr3
