// The thread of a pseudo-terminal: real terminals, no sleep. The test is the event loop.
#include "server/pty/pump.hpp"

#include <gtest/gtest.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <optional>

#include "server/files/data_files.hpp"
#include "tests/server/pty/slave.hpp"

namespace xr3 {
namespace {

using test::Slave;

/// While it exists, this process can open no file.
class NoDescriptors {
 public:
  NoDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const ::rlimit none{STDERR_FILENO + 1, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;
  ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  ::rlimit before_{};
};

class PtyPumpTest : public testing::Test {
 protected:
  /// Waits for a program, and takes its line.
  bool accept() {
    return notices_.await([&] { return is_accepted(); });
  }
  bool is_accepted() {
    const std::scoped_lock use(shared_.use);
    if (!shared_.line.is_open()) return false;
    line_ = std::exchange(shared_.line, Descriptor());
    return true;
  }
  bool await_round() {
    const std::uint64_t round = pump_.begin_round();
    return notices_.await([&] {
      const std::scoped_lock use(shared_.use);
      return shared_.rounds_ended >= round;
    });
  }
  /// The reason why programs are not served; empty: they are.
  std::string failure() {
    const std::scoped_lock use(shared_.use);
    if (!shared_.failure) return "";
    try {
      std::rethrow_exception(shared_.failure);
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  /// What the line has now.
  std::string read() {
    std::array<char, 8192> bytes{};
    const ssize_t count = ::recv(line_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    return count < 0 ? "" : std::string(bytes.data(), static_cast<std::size_t>(count));
  }
  /// Waits for this many bytes, or the end of the line.
  std::string await(std::size_t count) {
    std::string all;
    ::pollfd state{line_.get(), POLLIN, 0};
    while (all.size() < count && ::poll(&state, 1, 20'000) == 1) {
      const std::string more = read();
      if (more.empty()) break;
      all += more;
    }
    return all;
  }
  bool has_ended() { return await(1).empty(); }
  bool write(const std::string& bytes) {
    return ::send(line_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) == std::ssize(bytes);
  }
  /// The last settings of the line.
  PtyModes modes() {
    const std::scoped_lock use(shared_.use);
    return shared_.changes.back().modes;
  }
  /// The modes that a program finds.
  static PtyModes found_by(const Slave& program) {
    struct ::termios modes {};
    EXPECT_EQ(::tcgetattr(program.file(), &modes), 0);
    return {::cfgetospeed(&modes) == B9600 ? 9600U : 0U, modes.c_lflag != 0};
  }
  /// A program that has only changed the settings may have been taken for a line.
  void end_line() {
    if (is_accepted()) EXPECT_TRUE(has_ended());
    line_ = Descriptor();
  }

  test::PtyFolder folder_;
  test::Notices notices_;
  PtyPump pump_{folder_.file("rhino"), 0600, [this] { notices_.give(); }};
  PtyShared& shared_ = pump_.shared();
  Descriptor line_;
};

TEST_F(PtyPumpTest, CarriesBytesBothWays) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  program.write("E?");
  EXPECT_EQ(await(2), "E?");
  EXPECT_TRUE(write(" "));
  EXPECT_EQ(program.await(1), " ");
}

TEST_F(PtyPumpTest, AProgramThatComesAndGoesIsALineWithItsBytes) {
  const std::string bytes(10'000, 'E');
  Slave(pump_.path()).write(bytes);
  ASSERT_TRUE(accept());
  EXPECT_EQ(await(std::string::npos), bytes);
}

TEST_F(PtyPumpTest, ARoundMovesBytesThatProgramsHaveWritten) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  for (int i = 0; i < 200; ++i) {
    program.write("E?");
    ASSERT_TRUE(await_round());
    ASSERT_EQ(read(), "E?");
  }
}

TEST_F(PtyPumpTest, ARoundFindsProgramsThatHaveComeBefore) {
  const Slave program(pump_.path());
  EXPECT_TRUE(await_round());
  EXPECT_TRUE(is_accepted());
}

TEST_F(PtyPumpTest, ALineThatIsNotReadHasTheLastBytesAndTheEnd) {
  std::string bytes;
  {
    const Slave program(pump_.path());
    ASSERT_TRUE(accept());
    const std::string piece(500, 'E');
    ::pollfd room{program.file(), POLLOUT, 0};
    while (::poll(&room, 1, 200) == 1) {
      const ssize_t count = ::write(program.file(), piece.data(), piece.size());
      if (count > 0) bytes += piece.substr(0, static_cast<std::size_t>(count));
    }
  }
  ::pollfd end{line_.get(), POLLRDHUP, 0};
  EXPECT_EQ(::poll(&end, 1, 20'000), 1) << "told before a byte is read";
  EXPECT_EQ(await(std::string::npos), bytes);
}

TEST_F(PtyPumpTest, BytesOfAProgramThatReadsNothingStayInTheTerminal) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  const std::string replies(1000, ' ');
  std::size_t sent = 0;
  ::pollfd room{line_.get(), POLLOUT, 0};
  while (::poll(&room, 1, 200) == 1) {
    const ssize_t count = ::send(line_.get(), replies.data(), replies.size(), 0);
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  EXPECT_LT(sent, 64U * 1024) << "the line waits";
  EXPECT_EQ(program.await(sent).size(), sent);
  EXPECT_EQ(::poll(&room, 1, 20'000), 1) << "there is room again";
}

TEST_F(PtyPumpTest, RepliesToNoProgramAreDiscarded) {
  {
    const Slave program(pump_.path());
    ASSERT_TRUE(accept());
  }
  ASSERT_TRUE(has_ended());
  const std::string replies(1000, ' ');
  ::pollfd room{line_.get(), POLLOUT, 0};
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(::poll(&room, 1, 20'000), 1);
    ASSERT_TRUE(write(replies));
  }
  line_ = Descriptor();
  const Slave next(pump_.path());
  ASSERT_TRUE(accept());
  EXPECT_EQ(next.read(), "");
}

TEST_F(PtyPumpTest, TheNextProgramFindsNoReplies) {
  {
    const Slave program(pump_.path());
    ASSERT_TRUE(accept());
    EXPECT_TRUE(write("reply"));
    ::pollfd arrived{program.file(), POLLIN, 0};
    EXPECT_EQ(::poll(&arrived, 1, 20'000), 1);
  }
  ASSERT_TRUE(has_ended());
  EXPECT_EQ(Slave(pump_.path()).read(), "");
}

TEST_F(PtyPumpTest, TwoProgramsShareALine) {
  std::optional<Slave> first(std::in_place, pump_.path());
  ASSERT_TRUE(accept());
  const Slave second(pump_.path());
  second.set(B1200, 0);
  first.reset();
  second.write("E?");
  EXPECT_EQ(await(2), "E?");
  EXPECT_EQ(modes().baud, 1200U);
  EXPECT_FALSE(is_accepted());
}

TEST_F(PtyPumpTest, TheNextProgramIsALineWhenTheOneBeforeHasEnded) {
  {
    const Slave program(pump_.path());
    ASSERT_TRUE(accept());
  }
  ASSERT_TRUE(has_ended());
  const Slave next(pump_.path());
  next.write("E?");
  ASSERT_TRUE(await_round());
  EXPECT_FALSE(is_accepted());
  line_ = Descriptor();
  ASSERT_TRUE(accept());
  EXPECT_EQ(await(2), "E?");
}

TEST_F(PtyPumpTest, ALineThatTheServerEndsHangsUp) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  line_ = Descriptor();
  EXPECT_TRUE(program.await_hangup());
  const Slave next(pump_.path());
  EXPECT_TRUE(accept());
}

TEST_F(PtyPumpTest, ALineThatTheServerEndsHangsUpAProgramThatReadsNothing) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  const std::string replies(1000, ' ');
  ::pollfd room{line_.get(), POLLOUT, 0};
  while (::poll(&room, 1, 200) == 1) static_cast<void>(write(replies));
  line_ = Descriptor();
  EXPECT_TRUE(program.await_hangup());
  const Slave next(pump_.path());
  EXPECT_TRUE(accept());
}

TEST_F(PtyPumpTest, SettingsHoldFromTheByteAfterThem) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  program.write("E?");
  EXPECT_EQ(await(2), "E?");
  program.set(B1200, ICANON);
  program.write("F?\n");
  EXPECT_EQ(await(3), "F?\n");
  const std::scoped_lock use(shared_.use);
  ASSERT_EQ(shared_.changes.size(), 2U);
  EXPECT_EQ(shared_.changes[0].offset, 0U);
  EXPECT_EQ(shared_.changes[0].modes, (PtyModes{9600, false}));
  EXPECT_EQ(shared_.changes[1].offset, 2U);
  EXPECT_EQ(shared_.changes[1].modes, (PtyModes{1200, true}));
}

TEST_F(PtyPumpTest, TheLastBytesHaveTheSettingsOfTheirProgram) {
  {
    const Slave program(pump_.path());
    program.set(B1200, 0);
    program.write("E?");
  }
  ASSERT_TRUE(accept());
  EXPECT_EQ(await(std::string::npos), "E?");
  EXPECT_EQ(modes().baud, 1200U);
}

TEST_F(PtyPumpTest, SettingsOfAProgramThatHasGoneDoNotLast) {
  for (int i = 0; i < 50; ++i) {
    {
      const Slave program(pump_.path());
      program.set(B1200, ECHO);
      ASSERT_EQ(::ioctl(program.file(), TIOCEXCL), 0);
      ASSERT_EQ(::tcflow(program.file(), TCOOFF), 0);
    }
    ASSERT_TRUE(await_round());
    end_line();
    ASSERT_TRUE(await_round());
    {
      const Slave next(pump_.path());
      EXPECT_EQ(found_by(next), (PtyModes{9600, false}));
      ASSERT_TRUE(accept());
    }
    ASSERT_TRUE(has_ended());
    line_ = Descriptor();
  }
}

TEST_F(PtyPumpTest, ATerminalThatAProgramHasSpoiltIsReplaced) {
  for (int i = 0; i < 50; ++i) {
    const int null_discipline = N_NULL;
    ASSERT_EQ(::ioctl(Slave(pump_.path()).file(), TIOCSETD, &null_discipline), 0);
    ASSERT_TRUE(await_round());
    end_line();
    ASSERT_TRUE(await_round());
    int discipline = N_NULL;
    ASSERT_EQ(::ioctl(Slave(pump_.path()).file(), TIOCGETD, &discipline), 0);
    EXPECT_EQ(discipline, N_TTY);
    ASSERT_TRUE(await_round());
    end_line();
  }
}

TEST_F(PtyPumpTest, IsServedAgainWhenTheTerminalCanBeReplaced) {
  const Slave program(pump_.path());
  ASSERT_TRUE(accept());
  folder_.remove();
  line_ = Descriptor();
  ASSERT_TRUE(notices_.await([&] { return !failure().empty(); }));
  EXPECT_NE(failure().find(pump_.path()), std::string::npos) << failure();
  EXPECT_NE(failure().find("cannot be made"), std::string::npos) << failure();
  folder_.make();
  ASSERT_TRUE(notices_.await([&] { return failure().empty(); }));
  EXPECT_TRUE(program.await_hangup());
  const Slave next(pump_.path());
  EXPECT_TRUE(accept());
}

TEST_F(PtyPumpTest, ATerminalThatCannotBeMadeReadyIsReplaced) {
  std::optional<Slave> program(std::in_place, pump_.path());
  ASSERT_TRUE(accept());
  {
    const NoDescriptors none;
    program.reset();
    EXPECT_TRUE(has_ended());
    line_ = Descriptor();
    ASSERT_TRUE(notices_.await([&] { return !failure().empty(); }));
    EXPECT_NE(failure().find("Too many open files"), std::string::npos) << failure();
  }
  ASSERT_TRUE(notices_.await([&] { return failure().empty(); }));
  const Slave next(pump_.path());
  EXPECT_TRUE(accept());
}

TEST_F(PtyPumpTest, APathThatIsInUseIsRefused) {
  EXPECT_THROW(PtyPump(pump_.path(), 0600, [] {}), FileError);
}

}  // namespace
}  // namespace xr3
