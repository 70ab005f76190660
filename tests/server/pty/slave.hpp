// A program that has a pseudo-terminal open, and a wait for news of the server's side.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

#include "server/pty/pseudo_terminal.hpp"

namespace xr3::test {

class Slave {
 public:
  explicit Slave(const PseudoTerminal& terminal) : Slave(terminal.slave()) {}
  explicit Slave(const std::string& path)
      : file_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_GE(file_, 0);
  }
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;
  ~Slave() { ::close(file_); }

  int file() const { return file_; }
  void write(const std::string& text) const {
    EXPECT_EQ(::write(file_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// What has arrived.
  std::string read() const {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    return count < 0 ? "" : std::string(bytes.data(), static_cast<std::size_t>(count));
  }
  /// Whether the other side has gone.
  bool is_hung_up() const {
    ::pollfd state{file_, 0, 0};
    return ::poll(&state, 1, 0) == 1 && (state.revents & POLLHUP) != 0;
  }
  void set(speed_t speed, tcflag_t local) const {
    struct ::termios modes {};
    ASSERT_EQ(::tcgetattr(file_, &modes), 0);
    ::cfsetspeed(&modes, speed);
    modes.c_lflag = local;
    ASSERT_EQ(::tcsetattr(file_, TCSANOW, &modes), 0);
  }

 private:
  int file_;
};

/// A folder for links, removed at the end.
class PtyFolder {
 public:
  PtyFolder() { make(); }
  PtyFolder(const PtyFolder&) = delete;
  PtyFolder& operator=(const PtyFolder&) = delete;
  ~PtyFolder() { remove(); }

  void make() const { std::filesystem::create_directories(path_); }
  void remove() const { std::filesystem::remove_all(path_); }
  std::string file(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      ("pty." + std::to_string(::getpid()) + "." +
       testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() + "." +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Waits until a signal of the thread is given, and takes it. Returns false after a deadline.
inline bool take_signal(int descriptor) {
  constexpr int kDeadlineMs = 20'000;
  ::pollfd state{descriptor, POLLIN, 0};
  if (::poll(&state, 1, kDeadlineMs) != 1) return false;
  std::uint64_t count = 0;
  return ::read(descriptor, &count, sizeof count) == sizeof count;
}

/// Waits for signals until something is so. Returns false after a deadline.
template <class IsSo>
bool await(int descriptor, const IsSo& is_so) {
  while (!is_so())
    if (!take_signal(descriptor)) return false;
  return true;
}

}  // namespace xr3::test
