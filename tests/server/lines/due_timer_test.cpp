#include "server/lines/due_timer.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "server/net/wall_clock.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

/// A cell whose bytes take a hundredth of a second, and a line that has received an inquiry.
class DueTimerTest : public testing::Test {
 protected:
  void ask(const SimClock& clock) {
    cell_.emplace("main", test::rhino(), clock);
    cell_->set_line_speed({parse_serial_settings("1200-8n1"), {}});
    timer_.emplace(io_, *cell_, [this] { ++advances_; });
    line_ = cell_->apply(LineOpened{"test"}, wall_now()).line;
    cell_->apply(BytesIn{line_, "A?"}, wall_now());
  }
  static SimClock real() { return SimClock::real(Rate{}, wall_now()); }
  std::string reply() const { return std::string(cell_->find_line(line_)->outbox()); }

  asio::io_context io_{1};
  std::optional<Cell> cell_;
  std::optional<DueTimer> timer_;
  LineId line_ = 0;
  int advances_ = 0;
};

TEST_F(DueTimerTest, ExecutesBytesWhenTheyAreDue) {
  ask(real());
  timer_->update();
  EXPECT_EQ(reply(), "");
  while (reply().empty()) {
    io_.restart();
    ASSERT_EQ(io_.run_one(), 1U);
    timer_->update();
  }
  EXPECT_EQ(reply(), " ");
}

TEST_F(DueTimerTest, WaitsOnceForAByteHoweverOftenItIsUpdated) {
  ask(real());
  for (int i = 0; i < 10; ++i) timer_->update();
  EXPECT_EQ(io_.run(), 1U);
  EXPECT_EQ(advances_, 1);
}

TEST_F(DueTimerTest, LeavesTheManualClockAlone) {
  ask(SimClock::manual());
  timer_->update();
  EXPECT_EQ(io_.run(), 0U);
}

TEST_F(DueTimerTest, ClosingEndsTheWait) {
  ask(real());
  timer_->update();
  timer_->close();
  io_.run();
  EXPECT_EQ(advances_, 0);
}

TEST_F(DueTimerTest, WaitsForNothingAfterItIsClosed) {
  ask(real());
  timer_->close();
  timer_->update();
  EXPECT_EQ(io_.run(), 0U);
}

}  // namespace
}  // namespace xr3
