#include "server/pty/stream.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

#include "server/files/interrupted.hpp"

namespace xr3 {

PtyStream::PtyStream(PtyWatch& watch)
    : watch_(watch), place_(watch.place()), modes_(place_.terminal().modes()) {
  place_.begin_line();
}

bool PtyStream::is_over() const { return place_.stage() == PtyPlace::Stage::kLeft; }

// The last bytes of a program may arrive after its hangup: the thread tells whether there are more.
std::size_t PtyStream::read(std::span<char> into) {
  const auto use = place_.try_use();
  if (!use) return 0;
  if (is_over()) {
    note_ended();
    return 0;
  }
  const std::size_t count = read_arrived(into);
  if (count < into.size() && place_.is_leaving()) watch_.poll_soon();
  return count;
}

// A read without bytes would wait for the kernel.
std::size_t PtyStream::read_arrived(std::span<char> into) {
  const PseudoTerminal& terminal = place_.terminal();
  if (!terminal.has_bytes()) return 0;
  const auto count =
      retry_interrupted([&] { return ::read(terminal.master(), into.data(), into.size()); });
  if (count > 0) modes_ = terminal.modes();
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno != EAGAIN && errno != EIO) note_lost();
  return 0;
}

std::size_t PtyStream::unread_bytes() const {
  int count = 0;
  const int master = place_.terminal().master();
  return ::ioctl(master, FIONREAD, &count) == 0 ? static_cast<std::size_t>(count) : 0;
}

std::size_t PtyStream::write(std::string_view bytes) {
  const auto use = place_.try_use();
  if (!use) return 0;
  if (is_over()) return bytes.size();
  if (was_full_ && !place_.take_room()) return 0;
  const int master = place_.terminal().master();
  const auto count = retry_interrupted([&] { return ::write(master, bytes.data(), bytes.size()); });
  was_full_ = false;
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno != EAGAIN && errno != EIO) note_lost();
  if (is_lost()) return 0;
  if (errno == EIO || place_.is_leaving()) return bytes.size();
  was_full_ = true;
  watch_.await_room();
  return 0;
}

std::optional<LineSettings> PtyStream::take_settings(LineId line) {
  if (modes_ == taken_ || modes_.baud == 0) return std::nullopt;
  taken_ = modes_;
  return LineSettings{line, {modes_.baud, std::nullopt}, modes_.is_cooked};
}

}  // namespace xr3
