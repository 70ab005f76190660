// The measurement of the event loop: it finds a handler that takes long, and ends with the work.
#include "server/net/loop_lag.hpp"

#include <gtest/gtest.h>

#include <boost/asio/post.hpp>

namespace xr3 {
namespace {

constexpr WallNs kMillisecond = 1'000'000;
constexpr WallNs kBlocked = LoopLag::kInterval + 100 * kMillisecond;

class LoopLagTest : public testing::Test {
 protected:
  /// Occupies the event loop.
  void block() {
    asio::post(io_, [] {
      for (const WallNs end = wall_now() + kBlocked; wall_now() < end;) {
      }
    });
  }

  asio::io_context io_{1};
  int remaining_ = 0;  ///< measurements for which the server stays busy
  LoopLag lag_{io_, [this] { return remaining_-- > 0; }};
};

TEST_F(LoopLagTest, AnIdleLoopHasNoTimer) {
  EXPECT_EQ(io_.run(), 0U);
  EXPECT_EQ(lag_.max_at(wall_now()), 0);
}

TEST_F(LoopLagTest, MeasuresOnceForAnyAmountOfWork) {
  for (int i = 0; i < 100; ++i) lag_.begin_measurement();
  EXPECT_EQ(io_.run(), 1U);
  EXPECT_GT(lag_.max_at(wall_now()), 0);
  EXPECT_LT(lag_.max_at(wall_now()), 10'000 * kMillisecond);
}

TEST_F(LoopLagTest, FindsAHandlerThatTakesLong) {
  lag_.begin_measurement();
  block();
  io_.run();
  EXPECT_GE(lag_.max_at(wall_now()), 95 * kMillisecond);
}

TEST_F(LoopLagTest, GoesOnWhileTheServerIsBusy) {
  remaining_ = 2;
  lag_.begin_measurement();
  EXPECT_EQ(io_.run(), 3U);
}

TEST_F(LoopLagTest, ForgetsAfterAMinute) {
  lag_.begin_measurement();
  io_.run();
  const WallNs now = wall_now();
  const WallNs lag = lag_.max_at(now);
  EXPECT_EQ(lag_.max_at(now + LoopLag::kWindow), lag);
  EXPECT_EQ(lag_.max_at(now + 2 * LoopLag::kWindow), 0);
}

TEST_F(LoopLagTest, AfterTheStopNoTimerIsSet) {
  lag_.begin_measurement();
  lag_.stop();
  lag_.begin_measurement();
  EXPECT_EQ(io_.run(), 1U) << "the cancelled timer";
  lag_.begin_measurement();
  io_.restart();
  EXPECT_EQ(io_.run(), 0U);
}

}  // namespace
}  // namespace xr3
