// A program that has a pseudo-terminal open, and a wait for the thread of the server's side.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
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
  /// Waits until the other side has gone. Returns false after a deadline.
  bool await_hangup() const {
    ::pollfd state{file_, 0, 0};
    return ::poll(&state, 1, 20'000) == 1 && (state.revents & POLLHUP) != 0;
  }
  /// Waits for this many bytes, or until the other side has gone.
  std::string await(std::size_t count) const {
    std::string all;
    ::pollfd state{file_, POLLIN, 0};
    while (all.size() < count && ::poll(&state, 1, 20'000) == 1 && (state.revents & POLLIN) != 0)
      all += read();
    return all;
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

/// Counts the calls of a thread, and waits for them.
class Notices {
 public:
  void give() {
    const std::scoped_lock use(use_);
    ++count_;
    given_.notify_all();
  }
  /// Waits until the predicate holds, which it checks after each call. Returns false after a
  /// deadline.
  template <class Predicate>
  bool await(const Predicate& holds) {
    std::unique_lock use(use_);
    for (std::size_t seen = count_;; seen = count_) {
      use.unlock();
      if (holds()) return true;
      use.lock();
      if (!given_.wait_for(use, std::chrono::seconds(20), [&] { return count_ != seen; }))
        return false;
    }
  }

 private:
  std::mutex use_;
  std::condition_variable given_;
  std::size_t count_ = 0;
};

}  // namespace xr3::test
