#include "cell/device/mirror.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr Tick kBefore = Mirror::kStill - 1;

TEST(Mirror, CountersThatStandStillAndDifferAreReportedOnce) {
  Mirror mirror;
  EXPECT_FALSE(mirror.differs('E', {5, 0}, 0));
  EXPECT_FALSE(mirror.differs('E', {5, 0}, kBefore));
  EXPECT_TRUE(mirror.differs('E', {5, 0}, Mirror::kStill));
  EXPECT_FALSE(mirror.differs('E', {5, 0}, 10 * Mirror::kStill));
}

TEST(Mirror, CountersThatMoveAreNotCompared) {
  Mirror mirror;
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(mirror.differs('E', {i, 0}, i * kBefore));
    EXPECT_FALSE(mirror.differs('F', {0, i}, i * kBefore));
  }
}

TEST(Mirror, EqualCountersAreNoDifference) {
  Mirror mirror;
  for (Tick tick = 0; tick < 10 * Mirror::kStill; tick += 100)
    EXPECT_FALSE(mirror.differs('E', {0, 0}, tick));
}

TEST(Mirror, ADifferenceIsReportedAgainAfterAnAgreement) {
  Mirror mirror;
  mirror.differs('E', {5, 0}, 0);
  EXPECT_TRUE(mirror.differs('E', {5, 0}, 500));
  mirror.differs('E', {0, 0}, 600);
  mirror.differs('E', {5, 0}, 700);
  EXPECT_TRUE(mirror.differs('E', {5, 0}, 1200));
}

TEST(Mirror, IsLostOnceUntilItIsAligned) {
  Mirror mirror;
  EXPECT_TRUE(mirror.lose());
  EXPECT_FALSE(mirror.lose());
  mirror.align();
  EXPECT_TRUE(mirror.lose());
}

}  // namespace
}  // namespace xr3
