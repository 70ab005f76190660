// The thread of a pseudo-terminal: real terminals, no sleep.
#include "server/pty/watch.hpp"

#include <gtest/gtest.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "server/files/data_files.hpp"
#include "tests/server/pty/slave.hpp"

namespace xr3 {
namespace {

using test::Slave;
using Stage = PtyPlace::Stage;

class PtyWatchTest : public testing::Test {
 protected:
  bool await_stage(Stage stage) {
    return test::await(watch_.news().descriptor(), [&] { return place_.stage() == stage; });
  }
  bool await_round() {
    const std::uint64_t round = watch_.begin_round();
    return test::await(watch_.news().descriptor(), [&] { return watch_.has_ended(round); });
  }
  /// That of a program which has come and gone, if the thread has seen it while it was there.
  void end_line() {
    if (place_.stage() != Stage::kArrived) return;
    place_.begin_line();
    await_round();
    place_.end_line(place_.stage() != Stage::kLeft);
  }

  test::PtyFolder folder_;
  PtyWatch watch_{folder_.file("rhino"), 0600};
  PtyPlace& place_ = watch_.place();
};

TEST_F(PtyWatchTest, TellsThatAProgramHasArrived) {
  const Slave program(place_.path());
  EXPECT_TRUE(await_stage(Stage::kArrived));
}

TEST_F(PtyWatchTest, TellsThatAProgramHasComeAndGone) {
  Slave(place_.path()).write("E?");
  EXPECT_TRUE(await_stage(Stage::kArrived));
}

TEST_F(PtyWatchTest, ARoundHandsOnWhatProgramsHaveWritten) {
  const Slave program(place_.path());
  ASSERT_TRUE(await_stage(Stage::kArrived));
  place_.begin_line();
  for (int i = 0; i < 200; ++i) {
    program.write("E?");
    ASSERT_TRUE(await_round());
    ASSERT_TRUE(place_.terminal().has_bytes());
    char bytes[2];
    ASSERT_EQ(::read(place_.terminal().master(), bytes, sizeof bytes), 2);
  }
}

TEST_F(PtyWatchTest, ARoundFindsThoseWhoHaveComeBefore) {
  const Slave program(place_.path());
  EXPECT_TRUE(await_round());
  EXPECT_EQ(place_.stage(), Stage::kArrived);
}

TEST_F(PtyWatchTest, BytesAndTheEndAreNewsOfTheLine) {
  {
    const Slave program(place_.path());
    ASSERT_TRUE(await_stage(Stage::kArrived));
    place_.begin_line();
    program.write("E?");
    EXPECT_TRUE(
        test::await(place_.news_descriptor(), [&] { return place_.terminal().has_bytes(); }));
  }
  EXPECT_TRUE(test::await(place_.news_descriptor(), [&] { return place_.is_leaving(); }));
  char bytes[2];
  EXPECT_EQ(::read(place_.terminal().master(), bytes, sizeof bytes), 2);
  watch_.poll_soon();
  EXPECT_TRUE(
      test::await(place_.news_descriptor(), [&] { return place_.stage() == Stage::kLeft; }));
}

TEST_F(PtyWatchTest, RoomIsNews) {
  const Slave program(place_.path());
  ASSERT_TRUE(await_stage(Stage::kArrived));
  place_.begin_line();
  const std::string replies(1024, ' ');
  while (::write(place_.terminal().master(), replies.data(), replies.size()) > 0) {
  }
  ASSERT_TRUE(await_round());
  place_.take_room();
  watch_.await_room();
  while (!program.read().empty()) {
  }
  EXPECT_TRUE(test::await(place_.news_descriptor(), [&] { return place_.take_room(); }));
}

TEST_F(PtyWatchTest, ADroppedPlaceServesTheNextProgram) {
  const Slave program(place_.path());
  ASSERT_TRUE(await_stage(Stage::kArrived));
  place_.begin_line();
  place_.end_line(true);
  EXPECT_TRUE(await_round());
  EXPECT_EQ(place_.stage(), Stage::kIdle);
  EXPECT_TRUE(program.is_hung_up());
  const Slave next(place_.path());
  EXPECT_TRUE(await_stage(Stage::kArrived));
}

TEST_F(PtyWatchTest, AFailedPlaceIsNewsUntilItIsServedAgain) {
  const Slave program(place_.path());
  ASSERT_TRUE(await_round());
  place_.begin_line();
  folder_.remove();
  place_.end_line(true);
  watch_.poll_soon();
  EXPECT_TRUE(await_stage(Stage::kFailed));
  EXPECT_NE(place_.failure().find("cannot be"), std::string::npos) << place_.failure();
  folder_.make();
  EXPECT_TRUE(await_stage(Stage::kIdle));
  const Slave next(place_.path());
  EXPECT_TRUE(await_stage(Stage::kArrived));
}

TEST_F(PtyWatchTest, SettingsOfAProgramThatHasGoneDoNotLast) {
  for (int i = 0; i < 50; ++i) {
    {
      const Slave program(place_.path());
      program.set(B1200, ECHO);
      ASSERT_EQ(::ioctl(program.file(), TIOCEXCL), 0);
      ASSERT_EQ(::tcflow(program.file(), TCOOFF), 0);
    }
    ASSERT_TRUE(await_round());
    end_line();
    ASSERT_TRUE(await_round());
    EXPECT_EQ(place_.terminal().modes(), (PtyModes{9600, false}));
  }
}

TEST_F(PtyWatchTest, ATerminalThatAProgramHasSpoiltIsReplaced) {
  for (int i = 0; i < 50; ++i) {
    const int null_discipline = N_NULL;
    ASSERT_EQ(::ioctl(Slave(place_.path()).file(), TIOCSETD, &null_discipline), 0);
    ASSERT_TRUE(await_round());
    end_line();
    ASSERT_TRUE(await_round());
    int discipline = N_NULL;
    ASSERT_EQ(::ioctl(Slave(place_.path()).file(), TIOCGETD, &discipline), 0);
    EXPECT_EQ(discipline, N_TTY);
    ASSERT_TRUE(await_round());
    end_line();
  }
}

TEST_F(PtyWatchTest, APathThatIsInUseIsRefused) {
  EXPECT_THROW(PtyWatch(place_.path(), 0600), FileError);
}

}  // namespace
}  // namespace xr3
