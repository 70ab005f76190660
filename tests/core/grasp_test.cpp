// Jaws and blocks: when closing jaws turn a block flat, where they stop, what releases the block
// and what does not.
#include "core/grasp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/kinematics.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

constexpr double kHairDeg = 1e-5;

// Above the red block of the Rhino's table: tool down, net roll 90 degrees.
constexpr std::initializer_list<test::LabelledCount> kDown = {{'E', 449}, {'D', -625}};
constexpr Counts kFullyOpen = -16;

ModelPtr rhino_with(std::vector<Block> blocks, Workcell workcell = test::bare_workcell()) {
  workcell.blocks = std::move(blocks);
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper);
}

PointUm tip(const Rig& rig) {
  return tool_tip(rig.model(), positions(rig.model(), rig.state().motors));
}
double net_roll(const Rig& rig) {
  return net_roll_deg(rig.model(), positions(rig.model(), rig.state().motors));
}
Micrometres opening(const Rig& rig) {
  return micrometres(opening_mm(rig.model(), rig.position('A')));
}
const Block& block(const Rig& rig, std::size_t index = 0) { return rig.state().blocks[index]; }

const PointUm kPlace = tool_tip(*test::rhino(), test::positions_at(*test::rhino(), kDown));

Block block_at(const PointUm& centroid, double yaw_deg, PointUm size_um = {40'000, 30'000, 36'000},
               std::string name = "block") {
  return {std::move(name), size_um, centroid, microdegrees(yaw_deg), 1};
}

PointUm beside(const PointUm& place, Micrometres x, Micrometres y, Micrometres z = 0) {
  return {place.x + x, place.y + y, place.z + z};
}

/// The jaws are fully open around the blocks.
Rig over(std::vector<Block> blocks, Workcell workcell = test::bare_workcell()) {
  Rig rig(rhino_with(std::move(blocks), std::move(workcell)));
  rig.stand_at({{'E', 449}, {'D', -625}, {'A', kFullyOpen}});
  return rig;
}

void close_jaws(Rig& rig, int counts = 100) {
  rig.move('A', counts);
  rig.settle();
}

/// A block of 40 x 30 mm that lies flat, held by its width.
Rig holding(Workcell workcell = test::bare_workcell()) {
  Rig rig = over({block_at(kPlace, 90)}, std::move(workcell));
  close_jaws(rig);
  rig.execute(Stop{'A'});
  rig.simulation.take_events();
  return rig;
}

/// The smallest angle between two yaws, degrees.
double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

// --- A closing count without enough room turns the block flat.

struct TurnCase {
  double delta;  ///< yaw of the block minus the net roll, degrees
  int quarters;
};

constexpr TurnCase kTurns[] = {
    {0, 0},    {1, 0},     {20, 0},    {44, 0},    {46, 1},     {70, 1},     {90, 1},   {110, 1},
    {134, 1},  {136, 2},   {160, 2},   {180, 2},   {-20, 0},    {-44, 0},    {-46, -1}, {-70, -1},
    {-90, -1}, {-134, -1}, {-136, -2}, {-179, -2}, {44.999, 0}, {45.001, 1},
};

class TurnsFlat : public testing::TestWithParam<Counts> {};  // by the count of the base

TEST_P(TurnsFlat, TurnsABlockThatDoesNotFitToTheNearestQuarter) {
  for (const auto& [delta, quarters] : kTurns) {
    const Positions there =
        test::positions_at(*test::rhino(), {{'F', GetParam()}, {'E', 449}, {'D', -625}});
    const double roll = net_roll_deg(*test::rhino(), there);
    Rig rig(
        rhino_with({block_at(beside(tool_tip(*test::rhino(), there), 3000, -2000), roll + delta)}));
    rig.stand_at({{'F', GetParam()}, {'E', 449}, {'D', -625}, {'A', kFullyOpen}});
    const double radians = delta * kPi / 180;
    const double extent = 30 * std::abs(std::cos(radians)) + 40 * std::abs(std::sin(radians));
    const Block before = block(rig);
    const bool flat_already = std::fmod(delta, 90) == 0;
    while (static_cast<double>(opening(rig)) / 1000 - 0.79375 >= extent + 1e-3) {
      close_jaws(rig, 1);
      ASSERT_EQ(block(rig), before) << "room for it as it lies, delta " << delta;
    }
    close_jaws(rig, 1);
    EXPECT_EQ(block(rig).centroid_um == before.centroid_um, !flat_already)
        << "turned but not moved";
    EXPECT_LT(angle_between(degrees(block(rig).yaw_udeg), roll + 90 * quarters), kHairDeg) << delta;
    close_jaws(rig);
    const Micrometres flat = quarters % 2 == 0 ? 30'000 : 40'000;
    EXPECT_GE(opening(rig), flat) << delta;
    EXPECT_LT(opening(rig), flat + 794) << delta;
    ASSERT_TRUE(rig.state().held) << delta;
    EXPECT_EQ(block(rig).centroid_um, tip(rig)) << "held, its centroid is at the tip";
    EXPECT_LT(angle_between(degrees(block(rig).yaw_udeg), roll + 90 * quarters), kHairDeg) << delta;
  }
}

INSTANTIATE_TEST_SUITE_P(Grasp, TurnsFlat, testing::Values(0, 71, -138, 500));

TEST(Grasp, JawsNarrowerThanABlocksLengthDoNotGraspIt) {
  const PointUm slender{60'000, 12'000, 30'000};  // at 50 degrees 53.7 mm, flat on its length 60 mm
  Rig rig = over({block_at(kPlace, 90 + 50.0, slender)});
  close_jaws(rig);
  ASSERT_TRUE(rig.state().held);
  EXPECT_GE(opening(rig), 60'000);
  EXPECT_LT(angle_between(degrees(block(rig).yaw_udeg), 180), kHairDeg);

  Rig narrower = over({block_at(kPlace, 90 + 50.0, slender)});
  narrower.stand_at({{'E', 449}, {'D', -625}, {'A', -5}});  // 54.77 mm
  close_jaws(narrower);
  EXPECT_FALSE(narrower.state().held);
  EXPECT_EQ(block(narrower), block_at(kPlace, 140, slender));
}

// --- Where the jaws stop, and the value of A's error counter.

struct MeasureCase {
  Micrometres width;
  Counts stop;  ///< -ceil((width - home) / precision - 1e-6)
};

// Home 50.8 mm, 0.79375 mm per count.
constexpr MeasureCase kMeasures[] = {
    {32'000, 23}, {28'000, 28}, {50'800, 0},   {50'801, -1},  {50'799, 0},   {50'006, 1},
    {50'007, 0},  {1'000, 62},  {63'500, -16}, {63'000, -16}, {62'700, -15}, {11'906, 49},
};

TEST(Grasp, JawsStopAtTheLastCountThatLeavesRoom) {
  for (const auto& [width, stop] : kMeasures) {
    Rig rig = over({block_at(kPlace, 90, {70'000, width, 30'000})});
    close_jaws(rig, 100);
    ASSERT_TRUE(rig.state().held) << width;
    EXPECT_EQ(rig.count('A'), stop) << width;
    EXPECT_EQ(rig.motor('A').blocked, Blocked::kBlock) << width;
    EXPECT_EQ(rig.motor('A').phase, 0) << width;
    EXPECT_TRUE(rig.simulation.is_at_rest());
    EXPECT_EQ(rig.error('A'), 100 + (kFullyOpen - stop)) << "what was left of the closing move";
    EXPECT_EQ(rig.execute(QueryError{'A'}), Reply(ErrorMagnitude{100 + (kFullyOpen - stop)}));
  }
}

TEST(Grasp, ReportsTheGraspOnceAndThenTheBlockedJaws) {
  Rig rig = over({block_at(kPlace, 90)});
  close_jaws(rig);
  EXPECT_EQ(rig.events_of<Grasped>(), (std::vector<Grasped>{{"block", kPlace, 90'000'000}}));
  ASSERT_EQ(rig.events_of<MotorBlocked>().size(), 1U);
  EXPECT_EQ(rig.events_of<MotorBlocked>()[0].why, Blocked::kBlock);
  EXPECT_EQ(test::ticks_of<Grasped>(rig.simulation.events()),
            test::ticks_of<MotorBlocked>(rig.simulation.events()));
}

const std::vector<Warning> kTouches = {{WarningCode::kJawsTouch, 'A', 0, 0, "block"}};

TEST(Grasp, JawsThatOnlyTouchABlockDoNotHoldIt) {
  Rig rig = over({block_at(kPlace, 90)});
  close_jaws(rig, 26 - kFullyOpen);
  EXPECT_EQ(rig.count('A'), 26);
  EXPECT_EQ(rig.error('A'), 0);
  EXPECT_FALSE(rig.state().held);
  EXPECT_EQ(rig.events_of<Warning>(), kTouches);
  EXPECT_TRUE(std::holds_alternative<Warning>(rig.simulation.events().back().body))
      << "after the report that A has reached its target";
  close_jaws(rig, 1);
  EXPECT_EQ(rig.count('A'), 26);
  EXPECT_TRUE(rig.state().held);
  EXPECT_EQ(rig.events_of<Warning>(), kTouches) << "they hold it now";
}

TEST(Grasp, JawsThatTurnABlockAndStopAtItsWidthTouchIt) {
  Rig rig = over({block_at(kPlace, 90 + 20.0)});
  close_jaws(rig, 26 - kFullyOpen);
  EXPECT_NE(block(rig).yaw_udeg, microdegrees(110)) << "it was turned flat";
  EXPECT_EQ(rig.events_of<Warning>(), kTouches);
}

TEST(Grasp, OnlyAClosingMoveThatEndsAtTheWidthTouches) {
  Rig wider = over({block_at(kPlace, 90)});
  close_jaws(wider, 25 - kFullyOpen);
  EXPECT_TRUE(wider.events_of<Warning>().empty()) << "there is room for a count";

  Rig corners = over({block_at(kPlace, 90 + 30.0)});
  close_jaws(corners, 6 - kFullyOpen);  // 46.04 mm: the next count would turn the block
  EXPECT_EQ(block(corners), block_at(kPlace, 120));
  EXPECT_TRUE(corners.events_of<Warning>().empty()) << "at its corners, not at its width";

  Rig stopped = over({block_at(kPlace, 90)});
  stopped.move('A', 100);
  while (stopped.count('A') != 26) stopped.pass(1);
  stopped.execute(Stop{'A'});
  stopped.pass(1000);
  EXPECT_TRUE(stopped.events_of<Warning>().empty()) << "the move did not end, the program ended it";

  Rig opening_up = over({block_at(kPlace, 90)});
  opening_up.stand_at({{'E', 449}, {'D', -625}, {'A', 40}});
  opening_up.travel('A', -14);
  EXPECT_EQ(opening_up.count('A'), 26);
  EXPECT_TRUE(opening_up.events_of<Warning>().empty()) << "opening jaws are not meant to grasp";

  Rig nothing = over({block_at(beside(kPlace, 0, 60'000), 90)});
  close_jaws(nothing, 26 - kFullyOpen);
  EXPECT_TRUE(nothing.events_of<Warning>().empty()) << "nothing is between them";
}

TEST(Grasp, WithoutAStopAnOpeningMoveReducesTheRemainingCounts) {
  Rig rig = over({block_at(kPlace, 90)});
  close_jaws(rig);
  ASSERT_EQ(rig.error('A'), 58);
  rig.move('A', -20);
  rig.settle();
  EXPECT_EQ(rig.error('A'), 38);
  EXPECT_EQ(rig.count('A'), 26);
  EXPECT_TRUE(rig.state().held);
  rig.execute(Stop{'A'});
  EXPECT_EQ(rig.motor('A').blocked, Blocked::kNo);
  EXPECT_TRUE(rig.state().held) << "stopping is not opening";
  rig.move('A', -20);
  rig.settle();
  EXPECT_EQ(rig.count('A'), 6);
  EXPECT_FALSE(rig.state().held);
}

TEST(Grasp, AClosingMoveOfJawsThatHoldIsBlockedAtOnce) {
  Rig rig = holding();
  close_jaws(rig, 30);
  EXPECT_EQ(rig.count('A'), 26);
  EXPECT_EQ(rig.error('A'), 30);
  EXPECT_EQ(rig.motor('A').blocked, Blocked::kBlock);
  EXPECT_TRUE(rig.events_of<Grasped>().empty()) << "it was held already";
}

TEST(Grasp, JawsCloseIfNoBlockIsBetweenThem) {
  Rig rig = over({block_at(beside(kPlace, 20'001, 0), 90, {60'000, 40'000, 36'000}),
                  block_at(beside(kPlace, 0, 0, -18'001), 0)});
  const std::vector<Block> before = rig.state().blocks;
  close_jaws(rig, 80);
  EXPECT_EQ(rig.count('A'), 64) << "closed";
  EXPECT_EQ(rig.error('A'), 0);
  EXPECT_EQ(rig.state().blocks, before);
}

TEST(Grasp, ARobotWithNegativeClosingCountsGrasps) {
  Robot robot = test::robot_named("rhino-xr3");
  robot.tool.drive.direction = 1;
  robot.tool.drive.microswitch.position = 16;
  Workcell workcell = test::bare_workcell();
  workcell.blocks = {block_at(kPlace, 90)};
  Rig rig(std::make_shared<const Model>(robot, workcell, Profile::kPaper));
  rig.stand_at(kDown);
  rig.move('A', -100);
  rig.settle();
  EXPECT_TRUE(rig.state().held);
  EXPECT_EQ(rig.count('A'), -26);
  EXPECT_EQ(rig.error('A'), -74);
  rig.execute(Stop{'A'});
  rig.move('A', 1);
  rig.settle();
  EXPECT_FALSE(rig.state().held);
}

// --- Too narrow.

int narrow_warnings(const Rig& rig) {
  int count = 0;
  for (const Warning& warning : rig.events_of<Warning>())
    count += warning.code == WarningCode::kJawsTooNarrow ? 1 : 0;
  return count;
}

TEST(Grasp, JawsNarrowerThanTheBlockWarnOnceAndGraspNothing) {
  Rig rig = over({block_at(kPlace, 90)});
  rig.stand_at({{'E', 449}, {'D', -625}, {'A', 27}});
  close_jaws(rig, 10);
  EXPECT_EQ(rig.count('A'), 37) << "they close all the same";
  ASSERT_EQ(narrow_warnings(rig), 1);
  EXPECT_EQ(rig.events_of<Warning>()[0].block, "block");
  EXPECT_EQ(block(rig), block_at(kPlace, 90));
  EXPECT_FALSE(rig.state().held);
  close_jaws(rig, 10);
  EXPECT_EQ(narrow_warnings(rig), 1) << "the same closing goes on";
  rig.travel('A', -5);
  close_jaws(rig, 10);
  EXPECT_EQ(narrow_warnings(rig), 2) << "opened in between";
  rig.travel('B', 3);
  close_jaws(rig, 10);
  EXPECT_EQ(narrow_warnings(rig), 3) << "tried again at another place";
}

TEST(Grasp, TheBlocksExtentMustFitBetweenTheJaws) {
  Rig rig = over({block_at(kPlace, 90 + 30.0)});      // 46.0 mm as it lies, 30 mm flat
  rig.stand_at({{'E', 449}, {'D', -625}, {'A', 7}});  // 45.2 mm
  close_jaws(rig);
  EXPECT_FALSE(rig.state().held);
  EXPECT_EQ(narrow_warnings(rig), 1);
}

// --- The choice among several blocks.

TEST(Grasp, TheNearestCentroidIsGraspedThenTheFirstInTheFile) {
  const PointUm wide{60'000, 30'000, 36'000};
  struct Case {
    const char* what;
    std::vector<Block> blocks;
    std::uint32_t taken;
  };
  const Case cases[] = {
      {"nearer along x",
       {block_at(beside(kPlace, 0, 9000), 90, wide), block_at(beside(kPlace, 0, -8000), 90, wide)},
       1},
      {"nearer in height",
       {block_at(beside(kPlace, 0, 0, 12'000), 90), block_at(beside(kPlace, 0, 0, -11'999), 90)},
       1},
      {"just as near",
       {block_at(beside(kPlace, 0, 0, 12'000), 90), block_at(beside(kPlace, 0, 0, -12'000), 90)},
       0},
      {"around the tip before nearer",
       {block_at(beside(kPlace, 16'000, 0), 90), block_at(beside(kPlace, 0, 19'000), 90)},
       1},
  };
  for (const Case& c : cases) {
    Rig rig = over(c.blocks);
    close_jaws(rig);
    ASSERT_TRUE(rig.state().held) << c.what;
    EXPECT_EQ(rig.state().held->block, c.taken) << c.what;
    EXPECT_EQ(block(rig, 1 - c.taken), c.blocks[1 - c.taken]) << c.what << ": the other one stays";
  }
}

TEST(Grasp, OfTwoStackedBlocksTheOneAtTheTipIsGrasped) {
  const Block upper = block_at(beside(kPlace, 0, 0, 36'000), 90);
  const Block lower = block_at(kPlace, 90);
  for (const std::uint32_t wanted : {0U, 1U}) {
    Rig rig = over(wanted == 1 ? std::vector{upper, lower} : std::vector{lower, upper});
    close_jaws(rig);
    ASSERT_TRUE(rig.state().held);
    EXPECT_EQ(rig.state().held->block, wanted);
    rig.execute(Stop{'A'});
    rig.travel('E', -100);
    rig.travel('A', -10);
    EXPECT_EQ(block(rig, 1 - wanted), upper) << "the block below was removed: there is no gravity";
    EXPECT_EQ(block(rig, wanted).centroid_um, tip(rig));
  }
}

// --- What releases a block, and its pose then.

TEST(Grasp, TheFirstOpeningCountReleasesTheBlock) {
  Rig rig = holding();
  rig.move('A', -1);
  rig.pass(16);  // 60 counts per second
  EXPECT_TRUE(rig.state().held);
  rig.pass(1);
  EXPECT_EQ(rig.count('A'), 25);
  EXPECT_FALSE(rig.state().held);
  EXPECT_EQ(rig.events_of<Released>(), (std::vector<Released>{{"block", kPlace, 90'000'000}}));
}

TEST(Grasp, AReleaseInTheAirWarnsAfterIt) {
  Rig rig = holding();
  rig.travel('E', -207);
  rig.travel('D', 185);
  rig.simulation.take_events();
  rig.travel('A', -1);
  const auto gap = static_cast<int>(tip(rig).z - 18'000);
  EXPECT_GT(gap, 100'000);
  EXPECT_EQ(rig.events_of<Warning>(),
            (std::vector<Warning>{{WarningCode::kReleasedInAir, 'A', gap, 0, "block"}}));
  EXPECT_EQ(test::ticks_of<Released>(rig.simulation.events()),
            test::ticks_of<Warning>(rig.simulation.events()));
  ASSERT_TRUE(std::holds_alternative<Released>(rig.simulation.events()[1].body));
  EXPECT_TRUE(std::holds_alternative<Warning>(rig.simulation.events()[2].body));
}

TEST(Grasp, AReleaseIntoAnotherBlockWarns) {
  const Block lower = block_at({kPlace.x, kPlace.y, 18'000 - 36'000 + 5'000}, 0);
  Rig rig = over({block_at(kPlace, 90), Block{lower}});
  close_jaws(rig);
  rig.execute(Stop{'A'});
  rig.simulation.take_events();
  rig.travel('A', -1);
  ASSERT_EQ(rig.events_of<Warning>().size(), 1U);
  EXPECT_EQ(rig.events_of<Warning>()[0].code, WarningCode::kBlocksOverlap);
}

TEST(Grasp, ABlockPutBackOnTheTableIsReleasedInSilence) {
  Workcell table = test::bare_workcell();
  table.work_surface_um = kPlace.z - 18'000;
  Rig rig = holding(table);
  rig.travel('F', 100);
  rig.travel('A', -1);
  EXPECT_FALSE(rig.state().held);
  EXPECT_TRUE(rig.events_of<Warning>().empty());
}

struct LetGoCase {
  const char* what;
  std::initializer_list<test::LabelledCount> travel;
};

// The pitch tilts the hand; the released block is upright nevertheless.
const LetGoCase kLetGo[] = {
    {"where it was", {}},
    {"turned by the base", {{'F', 120}}},
    {"turned by the roll", {{'B', -333}}},
    {"lifted", {{'E', -207}, {'D', 185}}},
    {"tilted", {{'E', -207}, {'D', 185}, {'C', 300}}},
    {"tilted and turned", {{'E', -150}, {'C', -250}, {'B', 75}, {'F', -300}}},
};

TEST(Grasp, AReleasedBlockIsUprightAtTheTipWithTheNetRollAsYaw) {
  for (const double yaw : {90.0, 0.0, 180.0, 115.0, 20.0}) {
    for (const LetGoCase& c : kLetGo) {
      Rig rig = over({block_at(kPlace, yaw)});
      close_jaws(rig);
      rig.execute(Stop{'A'});
      const int quarters = rig.state().held->quarter_turns;
      for (const auto& [label, counts] : c.travel) rig.travel(label, counts);
      ASSERT_TRUE(rig.state().held) << c.what;
      rig.travel('A', -1);
      ASSERT_FALSE(rig.state().held) << c.what;
      EXPECT_EQ(block(rig).centroid_um, tip(rig)) << c.what;
      EXPECT_LT(angle_between(degrees(block(rig).yaw_udeg), net_roll(rig) + 90 * quarters),
                kHairDeg)
          << c.what;
      EXPECT_EQ(block_pose(rig.model(), rig.state(), 0)(2, 2), 1.0) << "upright: " << c.what;
      const Block there = block(rig);
      rig.pass(100'000);
      EXPECT_EQ(block(rig), there) << "nothing falls";
    }
  }
}

TEST(Grasp, AYawStaysWithinHalfATurn) {
  for (const Counts roll : {-2000, -577, 288, 576, 1152, 3000}) {
    Rig rig = holding();
    rig.travel('B', roll);
    rig.travel('A', -1);
    EXPECT_GT(block(rig).yaw_udeg, -180'000'000) << roll;
    EXPECT_LE(block(rig).yaw_udeg, 180'000'000) << roll;
    EXPECT_LT(angle_between(degrees(block(rig).yaw_udeg), 90 - 0.3125 * roll), kHairDeg) << roll;
  }
}

}  // namespace
}  // namespace xr3
