#include "server/lines/silence_timer.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <memory>

#include "tests/support/models.hpp"
#include "tests/support/scripted_stream.hpp"

namespace xr3 {
namespace {

using test::reads;

struct NoSource final : LineSource {
  void accept_arrived() override {}
  void line_ended(LineId, LineCloseReason) override {}
};

/// A cell with the byte clock, whose motor E is in motion after a command of its line.
class SilenceTimerTest : public testing::Test {
 protected:
  ~SilenceTimerTest() override {
    timer_.close();
    lines_.abort();
    turns_.close();
    io_.restart();
    io_.run();
  }

  void begin(const ByteClockSettings& settings) {
    cell_.set_byte_clock(settings);
    lines_.add(source_);
    lines_.open(source_, std::make_unique<test::ScriptedStream>(std::deque{reads("E+50\r")}),
                LineOpened{});
    lines_.run_turns();
    ASSERT_FALSE(cell_.is_at_rest());
    timer_.update();
  }
  Counts count_e() const { return cell_.state().motor(cell_.model().index_of('E')).count; }

  asio::io_context io_{1};
  LineTurns turns_{io_};
  Cell cell_{"main", test::rhino(), SimClock::bytes()};
  NoSource source_;
  LineSessions lines_{turns_, cell_, [] {}};
  int rests_ = 0;
  SilenceTimer timer_{io_, cell_, lines_, [this] { ++rests_; }};
};

TEST_F(SilenceTimerTest, SilenceLetsTheRobotRunToRest) {
  begin({.settle_ms = 1});
  while (rests_ == 0) io_.run_one();
  EXPECT_EQ(count_e(), 50);
  timer_.update();
  io_.poll();
  EXPECT_EQ(rests_, 1) << "a robot at rest needs no silence";
}

TEST_F(SilenceTimerTest, WithoutASettleTimeSilenceHasNoEffect) {
  begin({});
  io_.poll();
  EXPECT_EQ(rests_, 0);
  EXPECT_LT(count_e(), 50);
}

TEST_F(SilenceTimerTest, ClosingEndsTheWait) {
  begin({.settle_ms = 0});
  timer_.close();
  io_.poll();
  EXPECT_EQ(rests_, 0);
}

TEST_F(SilenceTimerTest, WaitsForNothingAfterItIsClosed) {
  timer_.close();
  begin({.settle_ms = 0});
  io_.poll();
  EXPECT_EQ(rests_, 0);
}

}  // namespace
}  // namespace xr3
