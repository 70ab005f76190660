#include "server/lines/hold_timer.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <memory>

#include "tests/support/models.hpp"
#include "tests/support/scripted_stream.hpp"

namespace xr3 {
namespace {

using test::accepts;
using test::reads;

struct QuietSource final : LineSource {
  void accept_arrived() override {}
  void line_ended(LineId, LineCloseReason) override {}
};

/// A frozen cell with a line whose reply waits.
class HoldTimerTest : public testing::Test {
 protected:
  HoldTimerTest() {
    call(call::Freeze{});
    lines_.add(source_);
    auto stream = std::make_unique<test::ScriptedStream>(std::deque{reads("E?"), accepts(" ")});
    stream_ = stream.get();
    lines_.open(source_, std::move(stream), LineOpened{});
    lines_.run_turns();
    timer_.update();
  }
  ~HoldTimerTest() override {
    timer_.close();
    lines_.abort();
    turns_.close();
    io_.restart();
    io_.run();
  }
  void call(const call::Call& wanted) { cell_.apply(Input{wanted}, 0); }

  asio::io_context io_{1};
  LineTurns turns_{io_};
  Cell cell_{"main", test::rhino(), SimClock::manual()};
  QuietSource source_;
  LineSessions lines_{turns_, cell_, [] {}};
  HoldTimer timer_{io_, cell_, lines_};
  test::ScriptedStream* stream_ = nullptr;
};

TEST_F(HoldTimerTest, RepliesLeaveWhenTimePassesAgain) {
  EXPECT_FALSE(stream_->is_done());
  call(call::Unfreeze{});
  timer_.update();
  lines_.run_turns();
  EXPECT_TRUE(stream_->is_done());
}

TEST_F(HoldTimerTest, RepliesLeaveAfterTheirTime) {
  const WallNs start = wall_now();
  while (!stream_->is_done()) {
    io_.run_one();
    lines_.run_turns();
  }
  EXPECT_GE(wall_now() - start, LineSession::kFrozenReply * 9 / 10);
}

TEST_F(HoldTimerTest, ClosingEndsTheWait) {
  timer_.close();
  call(call::Unfreeze{});
  timer_.update();
  lines_.run_turns();
  EXPECT_FALSE(stream_->is_done()) << "no line is woken";
}

}  // namespace
}  // namespace xr3
