// An arm on a slide, a first prismatic joint behind a mount: the whole arm, its protected region
// included, moves with the slide, and the inverse kinematics keeps the slide where it is told.
#include <gtest/gtest.h>

#include "core/inverse/inverse.hpp"
#include "core/inverse/reach.hpp"
#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::on_slide;
using test::positions_at;
using test::rhino;
using test::Rig;
using test::robot_named;

ModelPtr rhino_on_slide() {
  static const ModelPtr model = test::model_of(on_slide(robot_named("rhino-xr3")));
  return model;
}

constexpr std::initializer_list<LabelledCount> kPostures[] = {
    {}, {{'F', 90}, {'E', 40}, {'D', -60}}, {{'F', -300}, {'C', 77}, {'B', 48}, {'A', 20}}};

TEST(Slide, MovesTheToolAlongY) {
  for (const auto& posture : kPostures) {
    for (const Counts slide : {-500, -1, 0, 333, 500}) {
      Positions at = positions_at(*rhino_on_slide(), posture);
      at[0] = slide;
      const Positions bare = positions_at(*rhino(), posture);
      PointUm wanted = tool_tip(*rhino(), bare);
      wanted.y += Micrometres{slide} * 500;
      EXPECT_EQ(tool_tip(*rhino_on_slide(), at), wanted) << slide;
      EXPECT_EQ(net_roll_deg(*rhino_on_slide(), at), net_roll_deg(*rhino(), bare));
      const Transform moved = tool_transform(*rhino_on_slide(), at);
      EXPECT_TRUE((moved.block<3, 3>(0, 0))
                      .isApprox(tool_transform(*rhino(), bare).block<3, 3>(0, 0), 1e-12));
      EXPECT_EQ(micrometres(moved(1, 3)), wanted.y);
    }
  }
}

TEST(Slide, CarriesTheProtectedRegion) {
  const Model& model = *rhino_on_slide();
  const Positions there = positions_at(model, {{'G', 400}});
  EXPECT_EQ(base_shift(model, there), (PointUm{0, 200'000, 0}));
  EXPECT_TRUE(is_in_protected_region(model, there, {0, 200'000, 0}));
  EXPECT_TRUE(is_in_protected_region(model, there, {99'999, 200'000, 339'999}));
  EXPECT_FALSE(is_in_protected_region(model, there, {100'000, 200'000, 0}));
  EXPECT_FALSE(is_in_protected_region(model, there, {0, 0, 0}));
}

// A slide along the base axis does not move that axis.
TEST(Slide, AlongTheBaseAxisLeavesTheRegionInItsPlace) {
  Robot robot = on_slide(robot_named("rhino-xr3"));
  robot.mount.reset();
  robot.joints[0].dh.alpha_deg = 0;
  const ModelPtr model = test::model_of(robot);
  EXPECT_EQ(base_shift(*model, positions_at(*model, {{'G', 400}})), (PointUm{}));
}

/// The counts of the shoulder, moved backwards, when the robot stalls.
Counts stalls_at(Rig& rig) {
  rig.travel('E', -400);
  EXPECT_EQ(rig.state().stall, Stall::kProtectedRegion);
  return rig.count('E');
}

TEST(Slide, TheArmStallsAtTheSamePostureEverywhere) {
  Rig bare;
  const Counts wanted = stalls_at(bare);
  for (const Counts slide : {-500, 0, 444}) {
    Rig rig(rhino_on_slide());
    rig.stand_at({{'G', slide}});
    EXPECT_EQ(stalls_at(rig), wanted) << slide;
  }
}

TEST(Slide, RunsToItsLimitsAndClosesItsSwitch) {
  Rig rig(rhino_on_slide());
  rig.travel('G', -40);
  EXPECT_TRUE(rig.motor('G').switch_closed);
  EXPECT_EQ(rig.execute(QuerySwitchesI{}), Reply(SwitchBits{16, 31, 0, 'I'}));
  rig.travel('G', -470);
  EXPECT_EQ(rig.count('G'), -500);
  EXPECT_EQ(rig.motor('G').blocked, Blocked::kLimit);
}

TEST(Slide, TheInverseKeepsItAtItsHomeOrWhereItIsTold) {
  const InverseResult bare = solve_inverse(*rhino(), down_target({262, 0, 20}, 90));
  for (const double slide : {0.0, 150.0}) {
    InverseOptions options;
    if (slide != 0) options.slide_mm = slide;
    const InverseResult result =
        solve_inverse(*rhino_on_slide(), down_target({262, slide, 20}, 90), options);
    EXPECT_EQ(result.method, InverseMethod::kFiveAxisArm);
    EXPECT_EQ(result.freedoms, std::vector{InverseFreedom::kSlide});
    ASSERT_EQ(result.solutions.size(), bare.solutions.size());
    for (std::size_t i = 0; i < bare.solutions.size(); ++i) {
      const InverseSolution& solution = result.solutions[i];
      EXPECT_EQ(solution.counts.motors[0], static_cast<Counts>(2 * slide));
      for (std::size_t k = 0; k < 5; ++k)
        EXPECT_EQ(solution.counts.motors[k + 1], bare.solutions[i].counts.motors[k]);
      EXPECT_LT(solution.exact.mm, 1e-6);
      EXPECT_EQ(solution.branch, bare.solutions[i].branch);
      EXPECT_EQ(solution.is_allowed(), bare.solutions[i].is_allowed());
    }
  }
}

TEST(Slide, PastItsLimitIsReported) {
  InverseOptions options;
  options.slide_mm = 300;
  const InverseResult result =
      solve_inverse(*rhino_on_slide(), down_target({262, 300, 20}, 90), options);
  ASSERT_FALSE(result.solutions.empty());
  ASSERT_FALSE(result.solutions[0].beyond.empty());
  EXPECT_EQ(result.solutions[0].beyond[0].joint, 0);
  EXPECT_EQ(result.solutions[0].beyond[0].counts, 100);
}

TEST(Slide, WidensTheReach) {
  EXPECT_FALSE(Reach(robot_named("rhino-xr3")).is_within(262, 500, 20));
  EXPECT_TRUE(Reach(on_slide(robot_named("rhino-xr3"))).is_within(262, 500, 20));
  EXPECT_FALSE(Reach(on_slide(robot_named("rhino-xr3"))).is_within(262, 750, 20));
}

TEST(Slide, AnArmOnAMountAloneHasItsClosedForm) {
  Robot robot = robot_named("rhino-xr3");
  robot.mount = DhRow{90, 100, 0, 0};
  const ModelPtr model = test::model_of(robot);
  const InverseResult result = solve_inverse(*model, down_target({0, 262, 120}, 180));
  EXPECT_EQ(result.method, InverseMethod::kFiveAxisArm);
  EXPECT_TRUE(result.freedoms.empty());
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_LT(result.solutions[0].exact.mm, 1e-6);
  EXPECT_EQ(result.solutions[0].counts.motors,
            solve_inverse(*rhino(), down_target({262, 0, 20}, 90)).solutions[0].counts.motors);
}

TEST(Slide, ChainAndSimulationAgree) {
  const Model& model = *rhino_on_slide();
  const Positions at = positions_at(model, {{'G', 111}, {'F', 50}, {'E', -30}, {'B', 9}});
  const auto exact = base_transforms_at(model.robot(), variables_at(model, at));
  const auto frames = base_transforms(model, at);
  ASSERT_EQ(exact.size(), frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_TRUE(exact[k].isApprox(frames[k], 1e-9)) << k;
}

}  // namespace
}  // namespace xr3
