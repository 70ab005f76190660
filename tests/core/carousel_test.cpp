// The carousel: which blocks ride on it, where its count puts them, and what its top means for the
// tool tip and for blocks that are put down.
#include "core/carousel.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/derived_state.hpp"
#include "core/grasp.hpp"
#include "core/inverse/inverse.hpp"
#include "core/placement.hpp"
#include "core/stall.hpp"
#include "core/workcell.hpp"
#include "core/workcell_edit.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

// Axis at (330, 330), radius 120, top at 40 mm; 288 counts are a quarter turn.
constexpr Micrometres kAxis = 330'000;
constexpr Micrometres kTop = 40'000;
constexpr Counts kQuarter = 288;

Block block(std::string name, Micrometres dx, Micrometres dy, Micrometres bottom,
            double yaw_deg = 0) {
  const PointUm size{60'000, 30'000, 30'000};
  return {std::move(name),
          size,
          {kAxis + dx, kAxis + dy, bottom + size.z / 2},
          microdegrees(yaw_deg),
          12};
}

ModelPtr with_blocks(std::vector<Block> blocks, bool surface_stalls = false) {
  Workcell workcell = test::bare_workcell();
  workcell.workspace.y_um = 800'000;
  workcell.blocks = std::move(blocks);
  workcell.surface_stalls = surface_stalls;
  return std::make_shared<const Model>(test::robot_named("rhino-xr3-accessories"), workcell,
                                       Profile::kPaper);
}

PointUm place_of(const Rig& rig, std::size_t index) {
  return rig.state().blocks[index].centroid_um;
}

std::vector<std::uint32_t> riding(const State& state) {
  std::vector<std::uint32_t> blocks;
  for (const Rider& rider : state.riders) blocks.push_back(rider.block);
  return blocks;
}

TEST(Carousel, IsAMotorBehindTheTool) {
  const ModelPtr model = with_blocks({});
  EXPECT_EQ(model->joint_count(), 6);
  EXPECT_EQ(model->motor_count(), 8);
  EXPECT_EQ(model->carousel_index(), 7);
  EXPECT_EQ(model->index_of('H'), 7);
  EXPECT_EQ(model->labels(), "ABCDEFGH");
  EXPECT_EQ(model->name(7), "carousel");
  EXPECT_EQ(test::rhino()->carousel_index(), -1);
}

TEST(Carousel, ABlockTurnsAQuarterWithIt) {
  Rig rig(with_blocks({block("on", 70'000, 10'000, kTop, 30), block("off", 70'000, 0, 0)}));
  EXPECT_EQ(riding(rig.state()), std::vector<std::uint32_t>{0});
  rig.travel('H', kQuarter);
  EXPECT_EQ(place_of(rig, 0), (PointUm{kAxis - 10'000, kAxis + 70'000, kTop + 15'000}));
  EXPECT_EQ(rig.state().blocks[0].yaw_udeg, microdegrees(120));
  EXPECT_EQ(place_of(rig, 1), (PointUm{kAxis + 70'000, kAxis, 15'000})) << "under the top";
  rig.travel('H', -2 * kQuarter);
  EXPECT_EQ(place_of(rig, 0), (PointUm{kAxis + 10'000, kAxis - 70'000, kTop + 15'000}));
  EXPECT_EQ(rig.state().blocks[0].yaw_udeg, microdegrees(-60));
}

TEST(Carousel, TheDirectionOfItsMotorIsThatOfTheTable) {
  Robot robot = test::robot_named("rhino-xr3-accessories");
  robot.carousel->drive.direction = -1;
  Workcell workcell = test::bare_workcell();
  workcell.blocks = {block("on", 70'000, 0, kTop)};
  Rig rig(std::make_shared<const Model>(robot, workcell, Profile::kPaper));
  rig.travel('H', kQuarter);
  EXPECT_EQ(place_of(rig, 0).y, kAxis - 70'000);
}

// Rounding errors would add up in thousands of counts if each were computed from the last pose.
TEST(Carousel, ManyTurnsEndWhereTheyBegan) {
  Rig rig(with_blocks({block("on", 61'234, -17'777, kTop, 12.345)}));
  const State before = rig.state();
  for (int turn = 0; turn < 3; ++turn) rig.travel('H', 4 * kQuarter);
  EXPECT_EQ(rig.state().blocks, before.blocks);
  rig.travel('H', -12 * kQuarter - 77);
  rig.travel('H', 77);
  EXPECT_EQ(rig.state().blocks, before.blocks);
}

TEST(Carousel, BlocksOnRidingBlocksRide) {
  Rig rig(
      with_blocks({block("third", 40'000, 0, kTop + 60'000),
                   block("second", 60'000, 0, kTop + 30'000), block("first", 80'000, 0, kTop),
                   block("floating", 0, 80'000, kTop + 30'000), block("beside", 200'000, 0, 0)}));
  EXPECT_EQ(riding(rig.state()), (std::vector<std::uint32_t>{0, 1, 2}));
  rig.travel('H', 2 * kQuarter);
  EXPECT_EQ(place_of(rig, 0), (PointUm{kAxis - 40'000, kAxis, kTop + 75'000}));
  EXPECT_EQ(place_of(rig, 3), (PointUm{kAxis, kAxis + 80'000, kTop + 45'000}));
}

TEST(Carousel, ABlockStandsOnItIfItsCentreIsWithinTheRadius) {
  const auto rides = [](Micrometres dx, Micrometres bottom) {
    return !Rig(with_blocks({block("b", dx, 0, bottom)})).state().riders.empty();
  };
  EXPECT_TRUE(rides(120'000, kTop));
  EXPECT_FALSE(rides(120'001, kTop));
  EXPECT_TRUE(rides(0, kTop + kContactToleranceUm));
  EXPECT_FALSE(rides(0, kTop + kContactToleranceUm + 1));
  EXPECT_TRUE(rides(0, kTop - kContactToleranceUm));
}

TEST(Carousel, TheSoftHomeTurnsTheBlocksBack) {
  Rig rig(with_blocks({block("on", 70'000, 0, kTop)}));
  const std::vector<Block> before = rig.state().blocks;
  rig.travel('H', 100);
  EXPECT_NE(rig.state().blocks, before);
  rig.execute(SoftHome{});
  EXPECT_EQ(rig.count('H'), 0);
  EXPECT_EQ(rig.state().blocks, before);
}

TEST(Carousel, ItsSwitchHasABitOfI) {
  Rig rig(with_blocks({}));
  rig.travel('H', 30);
  EXPECT_EQ(rig.execute(QuerySwitchesI{}), Reply(SwitchBits{32, 63, 0, 'I'}));
  EXPECT_EQ(rig.execute(QuerySwitch{'H'}), Reply(SwitchState{true}));
}

// --- Picking and placing.

/// Counts of the arm for a place with the slide at its upper end, net roll 0.
void stand_over(Rig& rig, const PointUm& at) {
  InverseOptions options;
  options.slide_mm = 250;
  const InverseResult result =
      solve_inverse(rig.model(), down_target({mm(at.x), mm(at.y), mm(at.z)}, 0), options);
  ASSERT_FALSE(result.solutions.empty());
  ASSERT_TRUE(result.solutions[0].is_allowed());
  const Positions& counts = result.solutions[0].counts.motors;
  for (int k = 0; k < rig.model().joint_count(); ++k) {
    const char label = rig.model().motor(k).drive.label;
    rig.travel(label, counts[static_cast<std::size_t>(k)] - rig.count(label));
  }
  ASSERT_EQ(rig.state().stall, Stall::kNo);
}

void squeeze(Rig& rig) {
  rig.move('A', 127);
  rig.settle();
  rig.execute(Stop{'A'});
  ASSERT_TRUE(rig.state().held);
}

TEST(Carousel, AHeldBlockStaysInTheJawsAndRidesAfterItsRelease) {
  Rig rig(with_blocks({block("on", 70'000, 0, kTop), block("other", -70'000, 0, kTop)}));
  stand_over(rig, place_of(rig, 0));
  squeeze(rig);
  EXPECT_EQ(riding(rig.state()), std::vector<std::uint32_t>{1});
  const Transform in_jaws = block_pose(rig.model(), rig.state(), 0);
  rig.travel('H', kQuarter);
  EXPECT_EQ(block_pose(rig.model(), rig.state(), 0), in_jaws);
  EXPECT_EQ(place_of(rig, 1), (PointUm{kAxis, kAxis - 70'000, kTop + 15'000}));
  rig.simulation.take_events();
  rig.travel('A', -16 - rig.count('A'));
  EXPECT_TRUE(rig.events_of<Warning>().empty());
  EXPECT_EQ(riding(rig.state()), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(rig.state().riders[0].count, kQuarter);
  EXPECT_EQ(rig.state().riders[1].count, 0) << "an undisturbed rider keeps its entry";
  const PointUm released = place_of(rig, 0);
  rig.travel('H', kQuarter);
  EXPECT_EQ(place_of(rig, 0),
            (PointUm{kAxis - (released.y - kAxis), kAxis + (released.x - kAxis), released.z}));
  stand_over(rig, place_of(rig, 0));
  squeeze(rig);
}

TEST(Carousel, ItTurnsUnderJawsThatClose) {
  Rig rig(with_blocks({block("on", 70'000, 0, kTop)}));
  stand_over(rig, place_of(rig, 0));
  rig.move('H', 3);
  rig.move('A', 127);
  rig.settle();
  ASSERT_TRUE(rig.state().held);
  EXPECT_EQ(derived(rig.model(), rig.state()), rig.state());
}

// --- The top as a surface.

TEST(Carousel, WarnsOfABlockInTheAirAndInside) {
  const auto warnings = [](Micrometres dx, Micrometres bottom) {
    const ModelPtr model = with_blocks({block("b", dx, 0, bottom)});
    Events events;
    warn_of_placement(*model, Rig(model).state(), 0, events);
    return events;
  };
  const auto air = [](char label, int gap) {
    return Events{{0, Warning{WarningCode::kReleasedInAir, label, gap, 0, "b"}}};
  };
  const Events inside{{0, Warning{WarningCode::kBlocksOverlap, 'H', 0, 0, "b"}}};
  EXPECT_EQ(warnings(0, kTop), Events{});
  EXPECT_EQ(warnings(0, kTop + 5'000), air('H', 5'000));
  EXPECT_EQ(warnings(0, 0), inside);
  EXPECT_EQ(warnings(140'000, kTop), air('A', 40'000)) << "its centre is beside the carousel";
  EXPECT_EQ(warnings(140'000, 0), inside) << "it reaches 10 mm into the carousel";
  EXPECT_EQ(warnings(149'000, 0), Events{}) << "1 mm is within the tolerance";
}

TEST(Carousel, ItsTopIsASurfaceForTheTip) {
  const ModelPtr model = with_blocks({});
  EXPECT_FALSE(is_below_surface(*model, {kAxis, kAxis, kTop}));
  EXPECT_TRUE(is_below_surface(*model, {kAxis, kAxis, kTop - 1}));
  EXPECT_FALSE(is_below_surface(*model, {kAxis + 120'001, kAxis, 0}));
  EXPECT_TRUE(is_below_surface(*model, {kAxis + 120'001, kAxis, -1}));
}

TEST(Carousel, ATipThatEntersItSidewaysStallsIfTheSurfaceStalls) {
  Rig rig(with_blocks({}, true));
  stand_over(rig, {kAxis + 60'000, kAxis - 140'000, 20'000});
  rig.travel('G', 200);
  rig.travel('F', 200);
  EXPECT_EQ(rig.state().stall, Stall::kWorkSurface);
  EXPECT_TRUE(
      could_stall(rig.model(), positions(rig.model(), rig.state().motors), Stall::kWorkSurface));
}

// --- Edits from outside.

TEST(Carousel, RemovedBlocksLeaveAndOthersKeepTheirEntries) {
  const ModelPtr model = with_blocks({block("a", 90'000, 0, kTop), block("b", -70'000, 0, kTop),
                                      block("c", -70'000, 0, kTop + 30'000)});
  Rig rig(model);
  rig.travel('H', 100);
  remove_block(*model, rig.simulation.edit(), 0);
  EXPECT_EQ(riding(rig.state()), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(rig.state().riders[0].count, 0);
  remove_block(*model, rig.simulation.edit(), 0);
  EXPECT_TRUE(rig.state().riders.empty()) << "what stood on it floats and stays";
  rig.travel('H', 10);
}

TEST(Carousel, ANewWorkcellLiesAsItsFileSaysWhateverTheCount) {
  Rig rig(with_blocks({block("a", 70'000, 0, kTop)}));
  rig.travel('H', 100);
  const ModelPtr next = with_blocks({block("b", 0, 70'000, kTop)});
  rig.simulation.replace_workcell(next);
  EXPECT_EQ(rig.state().blocks, next->workcell().blocks);
  ASSERT_EQ(rig.state().riders.size(), 1U);
  EXPECT_EQ(rig.state().riders[0].count, 100);
}

TEST(Carousel, AStateIsItsOwnDerivedState) {
  Rig rig(with_blocks({block("a", 70'000, 3'000, kTop, 17), block("b", -70'000, 0, kTop)}));
  rig.travel('H', 131);
  EXPECT_EQ(derived(rig.model(), rig.state()), rig.state());
  State moved = rig.state();
  moved.blocks.edit()[1].centroid_um.x += 1;
  EXPECT_EQ(derived(rig.model(), moved), rig.state());
}

}  // namespace
}  // namespace xr3
