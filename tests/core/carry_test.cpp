// A block in the jaws: fixed in the tool's frame during all motions of the arm; the effect of a
// stall, a limit, a home and a reset.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>
#include <utility>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::Rig;

using Counted = std::initializer_list<LabelledCount>;

ModelPtr with_its_table(const std::string& robot) {
  return std::make_shared<const Model>(test::robot_named(robot), test::workcell_named(robot),
                                       Profile::kPaper);
}

Positions where(const Rig& rig) { return positions(rig.model(), rig.state().motors); }
PointUm tip(const Rig& rig) { return tool_tip(rig.model(), where(rig)); }

void grip(Rig& rig) {
  rig.move('A', 127);
  rig.settle();
  rig.execute(Stop{'A'});
  ASSERT_TRUE(rig.state().held);
  rig.simulation.take_events();
}

// --- Rigid in the tool's frame.

struct Posture {
  const char* robot;
  Counted pick;
  Counted travel;
};

const Posture kPostures[] = {
    {"rhino-xr3",
     {{'E', 449}, {'D', -625}},
     {{'E', -200}, {'C', 400}, {'B', 77}, {'F', -123}, {'D', 100}}},
    {"adept-one",
     {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}},
     {{'C', -100}, {'E', 300}, {'D', -500}, {'B', 99}}},
    {"intelledex-660",
     {{'E', 293}, {'D', -932}, {'C', -261}},
     {{'E', 200}, {'F', 150}, {'C', 333}, {'G', -444}, {'D', 200}, {'B', 300}}},
};

TEST(Carry, AHeldBlockIsRigidInTheToolFrameAndTilts) {
  for (const Posture& c : kPostures) {
    Rig rig(with_its_table(c.robot));
    rig.stand_at(c.pick);
    grip(rig);
    const std::uint32_t held = rig.state().held->block;
    const auto in_tool = [&]() -> Transform {
      return tool_transform(rig.model(), where(rig)).inverse() *
             block_pose(rig.model(), rig.state(), held);
    };
    const Transform as_grasped = in_tool();
    EXPECT_LT((as_grasped.block<3, 1>(0, 3).norm()), 1e-3) << "centroid at the tip";
    for (const auto& [label, counts] : c.travel) {
      rig.travel(label, counts);
      ASSERT_TRUE(rig.state().held) << c.robot << " " << label;
      EXPECT_LT((in_tool() - as_grasped).cwiseAbs().maxCoeff(), 1e-3) << c.robot << " " << label;
    }
    if (std::string(c.robot) != "adept-one") {
      EXPECT_LT(block_pose(rig.model(), rig.state(), held)(2, 2), 0.99) << "it was tilted";
    }
  }
}

// --- What does not release a block.

Workcell table_with(PointUm centroid, PointUm size) {
  Workcell workcell = test::bare_workcell();
  workcell.blocks = {{"block", size, centroid, 90'000'000, 1}};
  return workcell;
}

ModelPtr rhino_on(Workcell workcell) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"), std::move(workcell),
                                       Profile::kPaper);
}

PointUm down() {
  return tool_tip(*test::rhino(), test::positions_at(*test::rhino(), {{'E', 449}, {'D', -625}}));
}

Rig holding(bool surface_stalls = false, PointUm size = {40'000, 30'000, 36'000}) {
  Workcell workcell = table_with(down(), size);
  workcell.surface_stalls = surface_stalls;
  Rig rig(rhino_on(workcell));
  rig.stand_at({{'E', 449}, {'D', -625}, {'A', -16}});
  grip(rig);
  return rig;
}

void run_into_the_region(Rig& rig) {
  rig.travel('E', -100);
  for (int i = 0; i < 9 && rig.state().stall == Stall::kNo; ++i) rig.travel('D', -100);
  for (int i = 0; i < 9 && rig.state().stall == Stall::kNo; ++i) rig.travel('E', -100);
  ASSERT_EQ(rig.state().stall, Stall::kProtectedRegion);
}

TEST(Carry, AStallKeepsTheBlock) {
  Rig rig = holding();
  run_into_the_region(rig);
  const std::optional<Held> held = rig.state().held;
  ASSERT_TRUE(held);
  rig.move('A', -20);
  rig.pass(5000);
  EXPECT_EQ(rig.state().held, held);
  EXPECT_TRUE(rig.events_of<Released>().empty());
}

TEST(Carry, AStallAtTheSurfaceKeepsTheBlock) {
  Rig rig = holding(true);
  rig.travel('E', 100);
  ASSERT_EQ(rig.state().stall, Stall::kWorkSurface);
  EXPECT_TRUE(rig.state().held);
  EXPECT_GE(tip(rig).z, 0);
}

TEST(Carry, WithoutSurfaceStallsACrossingWarnsOnceAndKeepsTheBlock) {
  Rig rig = holding();
  rig.travel('E', 100);
  EXPECT_LT(tip(rig).z, 0);
  rig.travel('B', 20);
  ASSERT_EQ(rig.events_of<Warning>().size(), 1U);
  EXPECT_EQ(rig.events_of<Warning>()[0].code, WarningCode::kBelowSurface);
  EXPECT_TRUE(rig.state().held);
  rig.travel('E', -100);
  EXPECT_EQ(rig.events_of<Warning>().size(), 1U);
  rig.travel('E', 100);
  EXPECT_EQ(rig.events_of<Warning>().size(), 2U);
}

TEST(Carry, ALimitOfAnyMotorKeepsTheBlock) {
  Rig rig = holding(false, {70'000, 63'500, 36'000});  // as wide as the jaws open
  ASSERT_EQ(rig.count('A'), -16);
  rig.move('A', -5);
  rig.settle();
  EXPECT_EQ(rig.motor('A').blocked, Blocked::kLimit);
  EXPECT_TRUE(rig.state().held);
  rig.move('F', 127);
  for (int i = 0; i < 6; ++i) {
    rig.settle();
    rig.move('F', 127);
  }
  rig.settle();
  EXPECT_EQ(rig.motor('F').blocked, Blocked::kLimit);
  EXPECT_TRUE(rig.state().held);
}

TEST(Carry, ResetStopAndDisablingKeepTheBlock) {
  Rig rig = holding();
  const std::optional<Held> held = rig.state().held;
  for (const Command& command :
       {Command{ControllerReset{}}, Command{Stop{'A'}}, Command{ToggleSimulator{}},
        Command{SetSpeed{'A', 255}}, Command{ToggleDisplay{}}}) {
    rig.execute(command);
    rig.settle();
    EXPECT_EQ(rig.state().held, held);
  }
}

// --- Home.

TEST(Carry, SoftHomeLeavesTheBlockInPlace) {
  for (const bool stalled : {false, true}) {
    Rig rig = holding();
    rig.travel('F', 120);
    if (stalled) run_into_the_region(rig);
    if (!stalled) rig.travel('C', 200);
    const PointUm there = tip(rig);
    const double roll = net_roll_deg(rig.model(), where(rig));
    rig.simulation.take_events();
    rig.execute(SoftHome{});
    EXPECT_FALSE(rig.state().held);
    EXPECT_EQ(rig.state().blocks[0].centroid_um, there);
    EXPECT_NEAR(std::remainder(degrees(rig.state().blocks[0].yaw_udeg) - roll, 90.0), 0, 1e-5);
    EXPECT_EQ(rig.events_of<Released>().size(), 1U);
    ASSERT_EQ(rig.events_of<Warning>().size(), 1U);
    EXPECT_EQ(rig.events_of<Warning>()[0].code, WarningCode::kReleasedInAir);
    EXPECT_EQ(rig.count('A'), 0);
    EXPECT_EQ(rig.error('A'), 0);
    const Block left = rig.state().blocks[0];
    rig.travel('A', 20);
    rig.travel('F', 30);
    EXPECT_EQ(rig.state().blocks[0], left);
  }
}

TEST(Carry, ANewStartPutsEveryBlockBack) {
  Rig rig = holding();
  rig.travel('F', 50);
  rig.simulation.reset();
  EXPECT_FALSE(rig.state().held);
  EXPECT_EQ(rig.state().blocks, rig.model().workcell().blocks);
}

// --- A tick undone by the protected region leaves block and jaws unchanged.

struct UndoneCase {
  const char* what;
  double delta;   ///< yaw of the block minus the net roll
  Counts jaws;    ///< their count before
  int direction;  ///< of their next count
  bool held;
};

const UndoneCase kUndone[] = {
    {"would grasp", 0, 26, +1, false},          {"would turn it", 30, 5, +1, false},
    {"would say too narrow", 0, 40, +1, false}, {"would close on nothing yet", 0, -10, +1, false},
    {"would release", 0, -16, -1, true},
};

// The shoulder's first count would enter the region; the jaws' count is due in the same tick.
Rig about_to_stall(const UndoneCase& c) {
  Counts e = 0;
  const ModelPtr bare = test::rhino();
  const auto at = [&bare](Counts count) { return test::positions_at(*bare, {{'E', count}}); };
  const auto tip_at = [&](Counts count) { return tool_tip(*bare, at(count)); };
  while (!is_in_protected_region(*bare, at(e - 1), tip_at(e - 1))) --e;
  Workcell workcell = table_with(tip_at(e), {40'000, 30'000, 36'000});
  workcell.blocks.edit()[0].yaw_udeg =
      microdegrees(net_roll_deg(*bare, test::positions_at(*bare, {{'E', e}})) + c.delta);
  Rig rig(rhino_on(workcell));
  rig.stand_at({{'E', e}, {'A', c.jaws}});
  if (c.held) grip(rig);
  for (const char label : {'E', 'A'}) rig.execute(SetSpeed{label, 100});
  rig.move('A', 5 * c.direction);
  rig.move('E', -5);
  rig.pass(9);
  rig.simulation.take_events();
  return rig;
}

TEST(Carry, ATickThatStallsAtTheRegionChangesNeitherBlockNorJaws) {
  for (const UndoneCase& c : kUndone) {
    Rig rig = about_to_stall(c);
    State wanted = rig.state();
    ASSERT_EQ(wanted.held.has_value(), c.held) << c.what;
    wanted.tick += 1;
    wanted.stall = Stall::kProtectedRegion;
    rig.pass(1);
    EXPECT_EQ(rig.state(), wanted) << c.what;
    EXPECT_EQ(rig.simulation.events().size(), 1U) << c.what;
  }
}

TEST(Carry, WithoutTheStallTheSameTickActs) {
  for (const UndoneCase& c : kUndone) {
    Rig rig = about_to_stall(c);
    rig.execute(Stop{'E'});
    const State before = rig.state();
    rig.pass(1);
    const bool acted = rig.state().held != before.held || rig.state().blocks != before.blocks ||
                       !rig.events_of<Warning>().empty() || rig.count('A') != before.motor(5).count;
    EXPECT_TRUE(acted) << c.what;
  }
}

}  // namespace
}  // namespace xr3
