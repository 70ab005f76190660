// Random places of blocks: the same for a seed, and within the rules.
#include "protocol/goals/vary.hpp"

#include <gtest/gtest.h>

#include "core/inverse/reach.hpp"
#include "core/workcell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

const Robot& varied_robot() {
  static const Robot robot = test::robot_named("rhino-xr3");
  return robot;
}

TEST(Vary, TheSameSeedGivesTheSamePlaces) {
  const Workcell original = test::workcell_named("rhino-xr3");
  const auto first = varied(original, varied_robot(), {7});
  ASSERT_TRUE(first);
  EXPECT_EQ(first, varied(original, varied_robot(), {7}));
  EXPECT_NE(first, varied(original, varied_robot(), {8}));
  // On every machine: these numbers are part of what a seed means.
  EXPECT_EQ(first->blocks[0].centroid_um.z, original.blocks[0].centroid_um.z);
}

TEST(Vary, BlocksAreWithinReachInViewAndApart) {
  const Workcell original = test::workcell_named("rhino-xr3");
  const Reach reach(varied_robot());
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto result = varied(original, varied_robot(), {seed, 60'000, 90'000'000});
    ASSERT_TRUE(result) << seed;
    for (std::size_t i = 0; i < result->blocks.size(); ++i) {
      const Block& block = result->blocks[i];
      const Block& before = original.blocks[i];
      EXPECT_TRUE(reach.has_grasp(block)) << seed << " " << block.name;
      EXPECT_LE(std::abs(block.centroid_um.x - before.centroid_um.x), 60'000);
      EXPECT_LE(std::abs(normalized(block.yaw_udeg - before.yaw_udeg)), 90'000'000);
      for (std::size_t other = 0; other < i; ++other)
        EXPECT_LE(footprint_overlap_um(block, result->blocks[other]), 0) << seed;
    }
  }
}

TEST(Vary, ABlockOnAnotherStays) {
  Workcell workcell = test::workcell_named("rhino-xr3");
  workcell.blocks.edit().resize(2);
  workcell.blocks.edit()[1].centroid_um = workcell.blocks[0].centroid_um;
  workcell.blocks.edit()[1].centroid_um.z += 100'000;
  workcell.blocks.edit()[0].centroid_um.x += 200'000;
  const Block stays = workcell.blocks[1];
  const auto result = varied(workcell, varied_robot(), {1, 20'000, 0});
  if (result) EXPECT_EQ(result->blocks[1], stays);
}

TEST(Vary, ThereMayBeNoPlace) {
  Workcell workcell = test::workcell_named("rhino-xr3");
  const PointUm centroid = workcell.blocks[0].centroid_um;
  for (Block& block : workcell.blocks.edit()) block.centroid_um = centroid;
  for (Block& block : workcell.blocks.edit()) block.centroid_um.z = block.size_um.z / 2;
  EXPECT_FALSE(varied(workcell, varied_robot(), {1, 1'000, 0}));
}

}  // namespace
}  // namespace xr3
