// Conversion of wall time to ticks at every rate, without reading a clock.
#include "core/sim_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;
constexpr WallNs kSecond = 1'000 * kMs;
constexpr WallNs kStart = 123'456'789;

struct RateCase {
  Rate rate;
  WallNs later;
  Tick ticks;
};

constexpr RateCase kRates[] = {
    {{1'000'000}, kSecond, 1000},
    {{1'000'000}, kMs, 1},
    {{1'000'000}, kMs - 1, 0},
    {{1'000'000}, 31LL * 86'400 * kSecond, 2'678'400'000},
    {kSlowest, kSecond, 1},
    {kSlowest, kSecond - 1, 0},
    {{10'000}, kSecond, 10},
    {{2'500'000}, kSecond, 2500},
    {{10'000'000'000}, kSecond, 10'000'000},
    {kFastest, kSecond, 100'000'000},
    {kFastest, 10, 1},
    {kFastest, 365LL * 86'400 * kSecond, 3'153'600'000'000'000},
};

TEST(SimClock, TicksFollowTheRate) {
  for (const auto& [rate, later, ticks] : kRates) {
    const SimClock clock = SimClock::real(rate, kStart, 7);
    EXPECT_EQ(clock.at(kStart + later), 7 + ticks) << rate.millionths << " for " << later << " ns";
    EXPECT_EQ(clock.at(kStart), 7);
    EXPECT_EQ(clock.at(kStart - kSecond), 7) << "never before it began";
  }
}

TEST(SimClock, WhenReturnsTheFirstMomentOfATick) {
  std::mt19937_64 random(3);
  for (const std::int64_t millionths :
       {1'000LL, 1'234LL, 999'999LL, 1'000'000LL, 1'000'001LL, 7'777'777LL, 100'000'000'000LL}) {
    const SimClock clock = SimClock::real({millionths}, kStart, 1000);
    for (int i = 0; i < 2000; ++i) {
      const Tick tick = 1001 + static_cast<Tick>(random() % 1'000'000'000);
      const WallNs moment = clock.when(tick);
      ASSERT_EQ(clock.at(moment), tick) << millionths;
      ASSERT_EQ(clock.at(moment - 1), tick - 1) << millionths;
    }
    EXPECT_EQ(clock.when(1000), kStart);
    EXPECT_EQ(clock.when(5), kStart) << "the past is due at once";
  }
}

TEST(SimClock, KeepsItsTickWhilePaused) {
  SimClock clock = SimClock::real({2'000'000}, 0);
  clock.pause(kSecond);
  EXPECT_EQ(clock.mode(), ClockMode::kManual);
  EXPECT_EQ(clock.at(100 * kSecond), 2000);
  clock.resume(100 * kSecond);
  EXPECT_EQ(clock.mode(), ClockMode::kReal);
  EXPECT_EQ(clock.at(100 * kSecond), 2000);
  EXPECT_EQ(clock.at(101 * kSecond), 4000) << "at its previous rate";
}

TEST(SimClock, ResumeReturnsToTheModeOfTheStart) {
  SimClock clock = SimClock::bytes(5);
  EXPECT_EQ(clock.mode(), ClockMode::kBytes);
  EXPECT_EQ(clock.at(100 * kSecond), 5) << "wall time does not move it";
  clock.set_tick(7, kSecond);
  clock.pause(2 * kSecond);
  EXPECT_EQ(clock.mode(), ClockMode::kManual);
  clock.resume(3 * kSecond);
  EXPECT_EQ(clock.mode(), ClockMode::kBytes);
  EXPECT_EQ(clock.at(100 * kSecond), 7);
  EXPECT_EQ(SimClock::manual().running_mode(), ClockMode::kReal);
}

TEST(SimClock, ASecondPauseOrResumeChangesNothing) {
  SimClock clock = SimClock::real({}, 0);
  clock.pause(kSecond);
  clock.pause(2 * kSecond);
  EXPECT_EQ(clock.at(9 * kSecond), 1000);
  clock.resume(10 * kSecond);
  clock.resume(11 * kSecond);
  EXPECT_EQ(clock.at(12 * kSecond), 3000);
}

TEST(SimClock, AChangeOfRateKeepsTheTick) {
  SimClock clock = SimClock::real({}, 0);
  clock.set_rate({10'000'000}, kSecond);
  EXPECT_EQ(clock.at(kSecond), 1000);
  EXPECT_EQ(clock.at(2 * kSecond), 11'000);
  clock.pause(2 * kSecond);
  clock.set_rate({500'000}, 3 * kSecond);
  EXPECT_EQ(clock.at(3 * kSecond), 11'000);
  clock.resume(3 * kSecond);
  EXPECT_EQ(clock.at(5 * kSecond), 12'000);
}

TEST(SimClock, AManualClockIsSetToATick) {
  SimClock clock = SimClock::manual(5);
  EXPECT_EQ(clock.at(kSecond), 5);
  clock.set_tick(1'000'000'000'000, kSecond);
  EXPECT_EQ(clock.at(2 * kSecond), 1'000'000'000'000);
  clock.resume(3 * kSecond);
  EXPECT_EQ(clock.at(3 * kSecond + 4 * kMs), 1'000'000'000'004);
  clock.set_tick(0, 4 * kSecond);
  EXPECT_EQ(clock.at(4 * kSecond + 2 * kMs), 2) << "a new epoch";
}

}  // namespace
}  // namespace xr3
