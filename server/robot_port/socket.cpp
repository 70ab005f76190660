#include "server/robot_port/socket.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

#include "server/files/interrupted.hpp"
#include "server/net/acknowledge.hpp"

namespace xr3 {
namespace {

bool must_wait() { return errno == EAGAIN || errno == EWOULDBLOCK; }

// If unread input were left, close() would reset the connection, and replies that are still on
// their way would be lost.
void discard_input(int descriptor) {
  constexpr int kMaxReads = 16;
  std::array<char, 16 * 1024> discarded;
  for (int i = 0; i < kMaxReads; ++i) {
    if (::recv(descriptor, discarded.data(), discarded.size(), MSG_DONTWAIT) <= 0) return;
  }
}

}  // namespace

// Early bytes and those of the kernel are one read, since a read that fills less than `into` means
// that nothing is left. After early bytes the end of the connection is found by the next read.
std::size_t RobotSocket::read(std::span<char> into) {
  const std::size_t early = early_.copy(into.data(), into.size());
  early_.erase(0, early);
  into = into.subspan(early);
  const auto count = retry_interrupted(
      [&] { return ::recv(descriptor(), into.data(), into.size(), MSG_DONTWAIT); });
  const std::size_t all = early + (count > 0 ? static_cast<std::size_t>(count) : 0);
  if (all > 0) {
    is_unacknowledged_ = true;
    return all;
  }
  if (count == 0) set_ended();
  if (count < 0 && !must_wait()) set_lost();
  return 0;
}

std::size_t RobotSocket::write(std::string_view bytes) {
  const auto count = retry_interrupted([&] {
    return ::send(descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  });
  if (count >= 0) {
    has_written_ = true;
    is_unacknowledged_ = false;
    return static_cast<std::size_t>(count);
  }
  if (!must_wait()) set_lost();
  return 0;
}

void RobotSocket::acknowledge() {
  if (is_open() && std::exchange(is_unacknowledged_, false)) acknowledge_received(descriptor());
}

void RobotSocket::close() {
  if (!is_open()) return;
  if (has_written_) {
    ::shutdown(descriptor(), SHUT_WR);
    discard_input(descriptor());
  }
  connection_ = Descriptor();
}

}  // namespace xr3
