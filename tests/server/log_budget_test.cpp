// How much the log may write: a burst, then a rate, and the count of what was dropped.
#include "server/log_budget.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr WallNs kSecond = 1'000'000'000;
constexpr WallNs kStart = 5 * kSecond;
constexpr std::size_t kMessage = 64;

/// Writes messages as long as they are admitted; returns the number of bytes.
std::size_t flood(LogBudget& budget, WallNs now, std::size_t reserve = 0) {
  std::size_t bytes = 0;
  for (; budget.admit(now, reserve); bytes += kMessage) budget.spend(kMessage);
  return bytes;
}

TEST(LogBudget, ABurstMayBeWrittenAtOnce) {
  LogBudget budget(kStart);
  EXPECT_EQ(flood(budget, kStart), kMaxLogBurst);
  EXPECT_FALSE(budget.admit(kStart));
}

TEST(LogBudget, TheRateIsKeptFromThenOn) {
  LogBudget budget(kStart);
  flood(budget, kStart);
  for (int second = 1; second <= 3; ++second)
    EXPECT_EQ(flood(budget, kStart + second * kSecond), kMaxLogBytesPerSecond);
}

TEST(LogBudget, TheRateIsGrantedInSmallParts) {
  LogBudget budget(kStart);
  flood(budget, kStart);
  std::size_t bytes = 0;
  for (WallNs now = kStart; now <= kStart + kSecond; now += kSecond / 1000) {
    const std::size_t more = flood(budget, now);
    EXPECT_LE(more, kMaxLogBytesPerSecond / 50);
    bytes += more;
  }
  EXPECT_EQ(bytes, kMaxLogBytesPerSecond);
}

TEST(LogBudget, ALongSilenceGrantsNoMoreThanABurst) {
  LogBudget budget(kStart);
  flood(budget, kStart);
  EXPECT_EQ(flood(budget, kStart + 1'000'000 * kSecond), kMaxLogBurst);
}

TEST(LogBudget, AMessageMayExceedTheRestButIsTheLast) {
  LogBudget budget(kStart);
  budget.spend(kMaxLogBurst - 1);
  ASSERT_TRUE(budget.admit(kStart));
  budget.spend(kMessage);
  EXPECT_FALSE(budget.admit(kStart));
}

TEST(LogBudget, AReserveIsLeftForOthers) {
  LogBudget budget(kStart);
  EXPECT_EQ(flood(budget, kStart, 1024), kMaxLogBurst - 1024);
  EXPECT_EQ(flood(budget, kStart), 1024);
}

TEST(LogBudget, TellsOnceASecondHowManyMessagesWereDropped) {
  LogBudget budget(kStart);
  flood(budget, kStart);  // drops the last
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(budget.admit(kStart));
  EXPECT_EQ(budget.drain_dropped(kStart), 0);
  EXPECT_EQ(budget.drain_dropped(kStart + kSecond), 5);
  EXPECT_EQ(budget.drain_dropped(kStart + 2 * kSecond), 0);
}

}  // namespace
}  // namespace xr3
