// Places of the tool as a person moves it: what is not given stays, and a refusal names its cause
// and a place that can be reached.
#include "core/inverse/tool_place.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/coupling.hpp"
#include "core/stall.hpp"
#include "tests/core/inverse/words.hpp"

namespace xr3 {
namespace {

using namespace test;
Positions positions_at(const Model& model, const Positions& counts) {
  Motors motors{};
  for (std::size_t i = 0; i < counts.size(); ++i) motors[i].count = counts[i];
  return positions(model, motors);
}

ToolPlace place_of(const Model& model, const Positions& counts) {
  return place_at(model, positions_at(model, counts));
}

WantedPlace at(double x, double y, double z) { return {{x, y, z}, {}, {}, {}}; }

ReachedPlace reached(const Model& model, const Positions& start, const WantedPlace& wanted) {
  const auto found = reach_place(model, start, wanted);
  const auto* place = std::get_if<ReachedPlace>(&found);
  EXPECT_NE(place, nullptr);
  return place == nullptr ? ReachedPlace{} : *place;
}

Unreachable refused(const Model& model, const Positions& start, const WantedPlace& wanted) {
  const auto found = reach_place(model, start, wanted);
  const auto* no = std::get_if<Unreachable>(&found);
  EXPECT_NE(no, nullptr);
  return no == nullptr ? Unreachable{} : *no;
}

/// The Rhino above the red block, the hand down.
Positions above_red(const Model& model) {
  return motors_at(model, {{'E', 242}, {'D', -440}, {'A', 3}});
}

class ToolPlaceTest : public testing::Test {
 protected:
  const Model& rhino_ = *model_named(kRhino);
  const Positions start_ = above_red(rhino_);
};

TEST_F(ToolPlaceTest, PlaceHasTheAnglesOfTheHand) {
  const ToolPlace place = place_of(rhino_, start_);
  EXPECT_NEAR(place.pitch_deg, -90, 0.2);
  EXPECT_NEAR(place.roll_deg, 90, 1e-9);
  EXPECT_NEAR(place.offset_mm, 0, 1e-9);
  const ToolPlace home = place_of(rhino_, {});
  EXPECT_NEAR(home.pitch_deg, -90, 1e-9);
}

TEST_F(ToolPlaceTest, PitchAndRollStay) {
  const ToolPlace before = place_of(rhino_, start_);
  const ReachedPlace place = reached(rhino_, start_, at(250, 90, 80));
  EXPECT_NEAR((place.tip_mm - Eigen::Vector3d(250, 90, 80)).norm(), 0, 1.5);
  const ToolPlace after = place_of(rhino_, place.counts);
  EXPECT_NEAR(after.pitch_deg, before.pitch_deg, 0.2);
  EXPECT_NEAR(after.roll_deg, before.roll_deg, 0.5);
  EXPECT_EQ(place.counts[static_cast<std::size_t>(rhino_.tool_index())], 3) << "the jaws stay";
}

TEST_F(ToolPlaceTest, GivenAnglesAreTaken) {
  WantedPlace wanted = at(330, 0, 200);
  wanted.pitch_deg = -60;
  wanted.roll_deg = 45;
  const ToolPlace after = place_of(rhino_, reached(rhino_, start_, wanted).counts);
  EXPECT_NEAR(after.pitch_deg, -60, 0.2);
  EXPECT_NEAR(after.roll_deg, 45, 0.5);
}

TEST_F(ToolPlaceTest, HandTiltedTowardsTheBaseHasAPitchBeyondDown) {
  WantedPlace wanted = at(330, 60, 120);
  wanted.pitch_deg = -100;
  const ReachedPlace place = reached(rhino_, start_, wanted);
  EXPECT_NEAR(place_of(rhino_, place.counts).pitch_deg, -100, 0.2);
  const ReachedPlace further = reached(rhino_, place.counts, at(320, 60, 120));
  EXPECT_NEAR(place_of(rhino_, further.counts).pitch_deg, -100, 0.3);
}

TEST_F(ToolPlaceTest, BranchWithTheShortestTravelIsChosen) {
  const ReachedPlace near = reached(rhino_, start_, at(262, 0, 119));
  EXPECT_EQ(near.branch, "front, elbow up");
  for (int i = 0; i < rhino_.joint_count(); ++i)
    EXPECT_LT(
        std::abs(near.counts[static_cast<std::size_t>(i)] - start_[static_cast<std::size_t>(i)]),
        12)
        << i;
  WantedPlace other = at(262, 0, 119);
  other.branch = "sideways";
  EXPECT_EQ(refused(rhino_, start_, other).obstacle, Obstacle::kNoBranch);
}

TEST_F(ToolPlaceTest, RollGoesTheShortWay) {
  const Positions turned = motors_at(rhino_, {{'E', 242}, {'D', -440}, {'B', 700}});
  const ToolPlace before = place_of(rhino_, turned);
  const ReachedPlace place = reached(rhino_, turned, at(270, 0, 119));
  const auto roll = static_cast<std::size_t>(rhino_.index_of('B'));
  EXPECT_LT(std::abs(place.counts[roll] - turned[roll]), 20);
  EXPECT_NEAR(apart_deg(place_of(rhino_, place.counts).roll_deg, before.roll_deg), 0, 0.5);
}

TEST_F(ToolPlaceTest, BelowTheTableTheNearestPlaceIsStraightAbove) {
  const Unreachable no = refused(rhino_, start_, at(262, 0, -18));
  EXPECT_EQ(no.obstacle, Obstacle::kWorkSurface);
  EXPECT_NEAR(no.amount, 18, 1);
  ASSERT_TRUE(no.nearest);
  EXPECT_NEAR((no.nearest->tip_mm - Eigen::Vector3d(262, 0, 0)).norm(), 0, 1.5);
  EXPECT_FALSE(
      is_below_surface(rhino_, tool_tip(rhino_, positions_at(rhino_, no.nearest->counts))));
}

TEST_F(ToolPlaceTest, TooFarTheNearestPlaceIsOnTheWay) {
  const Unreachable no = refused(rhino_, start_, at(700, 0, 120));
  EXPECT_EQ(no.obstacle, Obstacle::kTooFar);
  EXPECT_GT(no.amount, 50);
  ASSERT_TRUE(no.nearest);
  EXPECT_GT(no.nearest->tip_mm.x(), 350);
  EXPECT_NEAR(no.nearest->tip_mm.y(), 0, 1);
  EXPECT_NEAR(no.nearest->tip_mm.z(), 120, 1.5);
}

TEST_F(ToolPlaceTest, LimitsAndTheProtectedRegionAreNamed) {
  const Unreachable region = refused(rhino_, start_, at(60, 0, 100));
  EXPECT_TRUE(region.obstacle == Obstacle::kProtectedRegion || region.obstacle == Obstacle::kLimit);
  WantedPlace up = at(262, 0, 120);
  up.pitch_deg = 90;
  const Unreachable limit = refused(rhino_, start_, up);
  EXPECT_EQ(limit.obstacle, Obstacle::kLimit);
  EXPECT_GT(limit.amount, 1);
  ASSERT_TRUE(limit.nearest);
  EXPECT_GT(place_of(rhino_, limit.nearest->counts).pitch_deg, -80);
}

TEST_F(ToolPlaceTest, ToolThatIsBelowTheTableMayMoveThere) {
  WantedPlace down = at(262, 0, 20);
  const Positions low = reached(rhino_, start_, down).counts;
  Positions below = low;
  below[static_cast<std::size_t>(rhino_.index_of('E'))] += 120;
  ASSERT_TRUE(is_below_surface(rhino_, tool_tip(rhino_, positions_at(rhino_, below))));
  const ToolPlace place = place_of(rhino_, below);
  const Eigen::Vector3d aside = place.tip_mm + Eigen::Vector3d(0, 5, 0);
  reached(rhino_, below, at(aside.x(), aside.y(), aside.z()));
}

TEST(ToolPlace, OtherArmsKeepTheirHandToo) {
  for (const char* name : {kAdept, kIntelledex}) {
    const Model& model = *model_named(name);
    const ToolPlace home = place_of(model, {});
    const Eigen::Vector3d tip = tool_transform(model, Positions{}).block<3, 1>(0, 3);
    const Eigen::Vector3d wanted = tip + Eigen::Vector3d(-10, 15, 5);
    const ReachedPlace place = reached(model, {}, at(wanted.x(), wanted.y(), wanted.z()));
    const ToolPlace after = place_of(model, place.counts);
    EXPECT_NEAR((place.tip_mm - wanted).norm(), 0, 1.5) << name;
    EXPECT_NEAR(after.pitch_deg, home.pitch_deg, 0.3) << name;
    EXPECT_NEAR(apart_deg(after.roll_deg, home.roll_deg), 0, 0.5) << name;
  }
}

TEST(ToolPlace, ScaraCannotTiltItsHand) {
  const Model& model = *model_named(kAdept);
  const Eigen::Vector3d tip = tool_transform(model, Positions{}).block<3, 1>(0, 3);
  WantedPlace wanted = at(tip.x(), tip.y(), tip.z());
  wanted.pitch_deg = -70;
  const Unreachable no = refused(model, {}, wanted);
  EXPECT_EQ(no.obstacle, Obstacle::kDirection);
  EXPECT_NEAR(no.amount, 20, 0.1);
}

}  // namespace
}  // namespace xr3
