// The stages of a pseudo-terminal's place, without the thread: the test polls it.
#include "server/pty/place.hpp"

#include <gtest/gtest.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <optional>

#include "server/files/data_files.hpp"
#include "tests/server/pty/slave.hpp"

namespace xr3 {
namespace {

using test::Slave;
using Stage = PtyPlace::Stage;

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

class PtyPlaceTest : public testing::Test {
 protected:
  Stage polled() {
    place_.poll();
    return place_.stage();
  }
  /// A line that serves a program.
  void serve(const Slave&) {
    ASSERT_EQ(polled(), Stage::kArrived);
    place_.begin_line();
  }
  std::size_t read() {
    std::array<char, 64> bytes{};
    const ssize_t count = ::read(place_.terminal().master(), bytes.data(), bytes.size());
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  }

  test::PtyFolder folder_;
  PtyPlace place_{folder_.file("rhino"), 0600};
};

TEST_F(PtyPlaceTest, IsIdleUntilAProgramArrives) {
  EXPECT_EQ(polled(), Stage::kIdle);
  const Slave program(place_.path());
  EXPECT_EQ(polled(), Stage::kArrived);
}

TEST_F(PtyPlaceTest, ModesOfAProgramThatHasGoneDoNotLast) {
  Slave(place_.path()).set(B1200, ECHO);
  EXPECT_EQ(polled(), Stage::kIdle);
  EXPECT_EQ(place_.terminal().modes().baud, 1200U) << "nobody has told that it was opened";
  place_.note_opened();
  EXPECT_TRUE(place_.poll()) << "opened to make it ready";
  EXPECT_EQ(place_.terminal().modes(), (PtyModes{9600, false}));
  EXPECT_FALSE(place_.poll()) << "it is ready";
}

TEST_F(PtyPlaceTest, IsReplacedIfAProgramThatHasGoneHasSpoiltIt) {
  const int null_discipline = N_NULL;
  ASSERT_EQ(::ioctl(Slave(place_.path()).file(), TIOCSETD, &null_discipline), 0);
  place_.note_opened();
  EXPECT_EQ(polled(), Stage::kDropped);
}

TEST_F(PtyPlaceTest, AProgramThatHasLeftBytesHasArrived) {
  Slave(place_.path()).write("E?");
  EXPECT_EQ(polled(), Stage::kArrived);
}

TEST_F(PtyPlaceTest, IsLeftWhenAllBytesAreRead) {
  {
    const Slave program(place_.path());
    serve(program);
    program.set(B1200, ECHO);
    program.write("E?");
    EXPECT_EQ(polled(), Stage::kServed);
    EXPECT_FALSE(place_.is_leaving());
  }
  EXPECT_EQ(polled(), Stage::kServed) << "E? is not read yet";
  EXPECT_TRUE(place_.is_leaving());
  EXPECT_EQ(read(), 2U);
  EXPECT_EQ(polled(), Stage::kLeft);
  EXPECT_EQ(place_.terminal().modes(), (PtyModes{9600, false})) << "ready for the next program";
  EXPECT_EQ(polled(), Stage::kLeft) << "until the line has ended";
  place_.end_line(false);
  EXPECT_EQ(polled(), Stage::kIdle);
}

TEST_F(PtyPlaceTest, RepliesAreNoneOfTheNextProgram) {
  {
    const Slave program(place_.path());
    serve(program);
    EXPECT_EQ(::write(place_.terminal().master(), "reply", 5), 5);
  }
  EXPECT_EQ(polled(), Stage::kLeft);
  EXPECT_EQ(Slave(place_.path()).read(), "");
}

TEST_F(PtyPlaceTest, AProgramThatComesInTimeGoesOnWithTheLine) {
  std::optional<Slave> first(std::in_place, place_.path());
  serve(*first);
  const Slave second(place_.path());
  second.set(B1200, 0);
  first.reset();
  EXPECT_EQ(polled(), Stage::kServed);
  EXPECT_FALSE(place_.is_leaving());
  EXPECT_EQ(place_.terminal().modes().baud, 1200U) << "its modes are kept";
}

TEST_F(PtyPlaceTest, ALineIsNotLeavingWhenAnotherProgramHasCome) {
  std::optional<Slave> first(std::in_place, place_.path());
  serve(*first);
  first->write("E?");
  first.reset();
  polled();
  ASSERT_TRUE(place_.is_leaving());
  EXPECT_EQ(read(), 2U);
  const Slave second(place_.path());
  EXPECT_EQ(polled(), Stage::kServed);
  EXPECT_FALSE(place_.is_leaving());
}

TEST_F(PtyPlaceTest, TheNextProgramIsNotServedBeforeTheLineHasEnded) {
  {
    const Slave program(place_.path());
    serve(program);
  }
  ASSERT_EQ(polled(), Stage::kLeft);
  const Slave next(place_.path());
  EXPECT_EQ(polled(), Stage::kLeft);
  place_.end_line(false);
  EXPECT_EQ(polled(), Stage::kArrived);
}

TEST_F(PtyPlaceTest, ADroppedProgramSeesAHangup) {
  const Slave program(place_.path());
  serve(program);
  place_.end_line(true);
  EXPECT_EQ(polled(), Stage::kDropped);
  EXPECT_FALSE(program.is_hung_up());
  place_.replace(PseudoTerminal(0600));
  EXPECT_TRUE(program.is_hung_up());
  EXPECT_EQ(polled(), Stage::kIdle);
  const Slave next(place_.path());
  EXPECT_EQ(polled(), Stage::kArrived);
}

TEST_F(PtyPlaceTest, ATerminalThatCannotBeMadeReadyIsReplaced) {
  serve(Slave(place_.path()));
  {
    const NoDescriptors none;
    EXPECT_EQ(polled(), Stage::kLeft);
  }
  place_.end_line(false);
  EXPECT_EQ(place_.stage(), Stage::kDropped);
  place_.replace(PseudoTerminal(0600));
  EXPECT_EQ(polled(), Stage::kIdle);
}

TEST_F(PtyPlaceTest, RoomIsToldOnce) {
  const Slave program(place_.path());
  serve(program);
  polled();
  EXPECT_TRUE(place_.take_room());
  EXPECT_FALSE(place_.take_room());
}

TEST_F(PtyPlaceTest, TellsWhyItHasFailed) {
  serve(Slave(place_.path()));
  place_.end_line(true);
  folder_.remove();
  try {
    place_.replace(PseudoTerminal(0600));
  } catch (const FileError&) {
    place_.fail();
  }
  EXPECT_EQ(place_.stage(), Stage::kFailed);
  EXPECT_NE(place_.failure().find(place_.path()), std::string::npos) << place_.failure();
}

}  // namespace
}  // namespace xr3
