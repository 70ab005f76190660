#include "server/pty/stream.hpp"

#include <unistd.h>

#include <cerrno>

#include "server/net/interrupted.hpp"

namespace xr3 {

// The error is EIO as soon as no program has the slave open and all bytes are read.
std::size_t PtyStream::read(std::span<char> into) {
  const auto count =
      retry_interrupted([&] { return ::read(terminal_.master(), into.data(), into.size()); });
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || errno == EIO)
    note_ended();
  else if (errno != EAGAIN)
    note_lost();
  return 0;
}

// Even a write that takes nothing wakes those who watch the master: a line whose program reads
// nothing, but has written more, would be reported again and again. (Not before each write, since
// poll() may wait for a worker of the kernel.)
std::size_t PtyStream::write(std::string_view bytes) {
  if (has_ended()) return bytes.size();
  if (was_full_ && !terminal_.has_room()) return 0;
  const auto count =
      retry_interrupted([&] { return ::write(terminal_.master(), bytes.data(), bytes.size()); });
  was_full_ = count < 0 && errno == EAGAIN;
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EIO) return bytes.size();
  if (errno != EAGAIN) note_lost();
  return 0;
}

std::optional<LineSettings> PtyStream::take_settings(LineId line) {
  const PtyModes now = terminal_.modes();
  if (now == modes_ || now.baud == 0) return std::nullopt;
  modes_ = now;
  return LineSettings{line, {now.baud, std::nullopt}, now.is_cooked};
}

}  // namespace xr3
