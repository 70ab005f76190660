#include "server/lines/load.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

TEST(LineLoad, HalfOfTheLatestTurnsIsForgottenInEachTurn) {
  LineLoad load(1'000, 0);
  load.begin_turn();
  load.add(100);
  EXPECT_EQ(load.at(0), 600U);
  load.begin_turn();
  EXPECT_EQ(load.at(0), 300U);
}

TEST(LineLoad, TurnsThatCostNothingDoNotHideThoseThatCostMuch) {
  LineLoad load(0, 5 * kMs);
  load.add(8'000'000);
  for (int turn = 0; turn < 100; ++turn) load.begin_turn();
  EXPECT_EQ(load.at(5 * kMs), 4'000'000U);
  EXPECT_EQ(load.at(5 * kMs + LineLoad::kHalfLife - 1), 4'000'000U);
  EXPECT_EQ(load.at(5 * kMs + LineLoad::kHalfLife), 2'000'000U);
  EXPECT_EQ(load.at(5 * kMs + 3 * LineLoad::kHalfLife), 500'000U);
}

TEST(LineLoad, AllWorkIsForgottenAtLast) {
  LineLoad load(0, 0);
  load.add(~std::uint64_t{0});
  for (int turn = 0; turn < 64; ++turn) load.begin_turn();
  EXPECT_EQ(load.at(1'000'000 * LineLoad::kHalfLife), 0U);
}

}  // namespace
}  // namespace xr3
