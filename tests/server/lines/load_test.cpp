#include "server/lines/load.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

TEST(LineLoad, TheWorkOfATurnIsASum) {
  LineLoad load(0, 0);
  load.begin_turn();
  load.add(100);
  load.add(50);
  EXPECT_EQ(load.at(0), 150U);
  load.begin_turn();
  load.add(60);
  EXPECT_EQ(load.at(0), 150U);
}

TEST(LineLoad, ATurnWithWorkForgetsASixteenthOfTheOneThatCostMost) {
  LineLoad load(1'600, 0);
  load.add(100);
  EXPECT_EQ(load.at(0), 1'600U);
  load.begin_turn();
  EXPECT_EQ(load.at(0), 1'500U);
  load.add(20'000);
  load.begin_turn();
  EXPECT_EQ(load.at(0), 20'000U);
}

// A line whose client does not read has many turns in which nothing can be done.
TEST(LineLoad, ATurnWithoutWorkForgetsNothing) {
  LineLoad load(0, 0);
  load.add(20'000);
  for (int turn = 0; turn < 100; ++turn) load.begin_turn();
  EXPECT_EQ(load.at(100 * kMs), 20'000U);
}

// A thousand lines that request an image in every third turn must not be taken for light ones when
// they do so.
TEST(LineLoad, ALineWithAnImageInEveryThirdTurnIsNeverLight) {
  LineLoad load(0, 0);
  load.add(24'000);
  for (int turn = 0; turn < 3; ++turn) {
    load.begin_turn();
    load.add(100);
  }
  EXPECT_GT(load.at(100 * kMs), 20'000U);
}

TEST(LineLoad, TurnsThatCostNothingDoNotHideThoseThatCostMuch) {
  LineLoad load(0, 5 * kMs);
  load.add(8'000'000);
  for (int turn = 0; turn < 200; ++turn) {
    load.begin_turn();
    load.add(1);
  }
  EXPECT_EQ(load.at(5 * kMs), 4'000'100U);
  EXPECT_EQ(load.at(5 * kMs + LineLoad::kHalfLife - 1), 4'000'100U);
  EXPECT_EQ(load.at(5 * kMs + LineLoad::kHalfLife), 2'000'050U);
  EXPECT_EQ(load.at(5 * kMs + 3 * LineLoad::kHalfLife), 500'012U);
}

TEST(LineLoad, AllWorkIsForgottenAtLast) {
  LineLoad load(0, 0);
  load.add(~std::uint64_t{0});
  for (int turn = 0; turn < 1'000; ++turn) {
    load.begin_turn();
    load.add(1);
  }
  EXPECT_EQ(load.at(1'000'000 * LineLoad::kHalfLife), 1U);
}

}  // namespace
}  // namespace xr3
