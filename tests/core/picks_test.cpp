// Every pick of the three default workcells, to the count: the joint positions, that the tip is in
// the block, where the jaws stop, and that the block moves with the tool when lifted.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
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

std::uint32_t index_of(const Rig& rig, const std::string& name) {
  std::uint32_t index = 0;
  while (rig.state().blocks.all().at(index).name != name) ++index;
  return index;
}

void grip(Rig& rig) {
  rig.move('A', 127);
  rig.settle();
  rig.execute(Stop{'A'});
  ASSERT_TRUE(rig.state().held);
  rig.simulation.take_events();
}

struct Pick {
  const char* robot;
  const char* block;
  std::initializer_list<double>
      angles_deg;  ///< of the joints from the base; mm for a prismatic one
  Counted at;
  Counted raised;  ///< the motors whose counts differ 100 mm higher
  Counts jaws;
};

const Pick kPicks[] = {
    {"rhino-xr3",
     "red",
     {0, -39.01, 109.89, -70.88, -90},
     {{'E', 449}, {'D', -625}},
     {{'E', 242}, {'D', -440}},
     23},
    {"rhino-xr3",
     "green",
     {16.22, -28.41, 82.80, -54.39, -8.78},
     {{'F', 71}, {'E', 543}, {'D', -479}, {'B', 260}},
     {{'E', 381}, {'D', -343}},
     28},
    {"rhino-xr3",
     "blue",
     {-14.97, -26.51, 78.10, -51.59, -154.97},
     {{'F', -66}, {'E', 559}, {'D', -455}, {'B', -208}},
     {{'E', 402}, {'D', -324}},
     28},
    {"rhino-xr3",
     "yellow",
     {32.68, -37.77, 112.12, -74.35, -27.32},
     {{'F', 144}, {'E', 460}, {'D', -655}, {'B', 201}},
     {{'E', 242}, {'D', -468}},
     28},
    {"rhino-xr3",
     "magenta",
     {-31.28, -39.45, 113.09, -73.65, -41.28},
     {{'F', -138}, {'E', 445}, {'D', -649}, {'B', 156}},
     {{'E', 228}, {'D', -457}},
     23},
    {"adept-one",
     "red",
     {42.02, 91.38, 157, 40.65},
     {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}},
     {{'C', -86}},
     40},
    {"adept-one",
     "green",
     {44.93, 70.20, 157, -55.28},
     {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}},
     {{'C', -86}},
     48},
    {"adept-one",
     "blue",
     {20.89, 74.41, 162, 11.48},
     {{'E', 209}, {'D', 744}, {'C', 124}, {'B', -251}},
     {{'C', -76}},
     40},
    {"adept-one",
     "yellow",
     {71.55, 111.97, 162, 69.58},
     {{'E', 715}, {'D', 1120}, {'C', 124}, {'B', -65}},
     {{'C', -76}},
     56},
    {"adept-one",
     "magenta",
     {32.47, 111.49, 152, -59.02},
     {{'E', 325}, {'D', 1115}, {'C', 104}, {'B', -477}},
     {{'C', -96}},
     48},
    {"intelledex-660",
     "red",
     {90, -90, 119.25, -93.16, 63.91, 0},
     {{'E', 293}, {'D', -932}, {'C', -261}},
     {{'E', 453}, {'D', -978}, {'C', -376}},
     22},
    {"intelledex-660",
     "green",
     {104.32, -90, 109.56, -69.08, 49.52, -20.68},
     {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}},
     {{'E', 336}, {'D', -743}, {'C', -494}},
     26},
    {"intelledex-660",
     "blue",
     {74.22, -90, 110.46, -71.31, 50.85, 54.22},
     {{'G', -158}, {'E', 205}, {'D', -713}, {'C', -392}, {'B', 174}},
     {{'E', 347}, {'D', -764}, {'C', -482}},
     26},
    {"intelledex-660",
     "yellow",
     {117.35, -90, 122.54, -109.35, 76.81, -37.65},
     {{'G', 273}, {'E', 325}, {'D', -1094}, {'C', -132}, {'B', -120}},
     {{'E', 517}, {'D', -1149}, {'C', -268}},
     22},
    {"intelledex-660",
     "magenta",
     {63.43, -90, 124.30, -112.71, 78.40, -6.57},
     {{'G', -266}, {'E', 343}, {'D', -1127}, {'C', -116}, {'B', -21}},
     {{'E', 541}, {'D', -1180}, {'C', -261}},
     22},
};

class Picks : public testing::TestWithParam<Pick> {
 protected:
  Picks() : rig(with_its_table(GetParam().robot)) { rig.stand_at(GetParam().at); }

  Rig rig;
};

std::string pick_name(const testing::TestParamInfo<Pick>& info) {
  return std::string(info.param.robot).substr(0, 5) + "_" + info.param.block;
}

TEST_P(Picks, TheCountsMatchTheJointsAndReachTheBlock) {
  int joint = 0;
  for (const double angle : GetParam().angles_deg) {
    const double value = rig.model().variable(joint, where(rig)[static_cast<std::size_t>(joint)]);
    const double precision = rig.model().motor(joint).drive.precision;
    EXPECT_NEAR(value, angle, precision + 0.005) << "joint " << joint + 1;
    ++joint;
  }
  EXPECT_EQ(joint, rig.model().joint_count());
  const Block& block = rig.state().blocks[index_of(rig, GetParam().block)];
  EXPECT_NEAR(mm(tip(rig).x), mm(block.centroid_um.x), 1.5);
  EXPECT_NEAR(mm(tip(rig).y), mm(block.centroid_um.y), 1.5);
  EXPECT_NEAR(mm(tip(rig).z), mm(block.centroid_um.z), 1.0);
  EXPECT_NEAR(tool_transform(rig.model(), where(rig))(2, 2), -1, 1e-4) << "the tool is down";
  const double turned = net_roll_deg(rig.model(), where(rig)) - degrees(block.yaw_udeg);
  EXPECT_NEAR(std::remainder(turned, 180.0), 0, 0.35) << "flat between the jaws";
}

TEST_P(Picks, TheJawsStopAtTheDocumentedCount) {
  rig.move('A', 127);
  rig.settle();
  ASSERT_TRUE(rig.state().held);
  EXPECT_EQ(rig.state().held->block, index_of(rig, GetParam().block));
  EXPECT_EQ(rig.count('A'), GetParam().jaws);
  EXPECT_EQ(rig.error('A'), 127 - GetParam().jaws);
  const Micrometres opening = micrometres(opening_mm(rig.model(), rig.position('A')));
  EXPECT_GE(opening, rig.state().blocks[rig.state().held->block].size_um.y);
  EXPECT_TRUE(rig.events_of<Warning>().empty());
}

TEST_P(Picks, LiftsTheBlockByAHundredMillimetresAndReleasesIt) {
  const std::vector<Block> before = rig.state().blocks;
  grip(rig);
  const std::uint32_t held = rig.state().held->block;
  const PointUm low = tip(rig);
  for (const auto& [label, count] : GetParam().raised) rig.travel(label, count - rig.count(label));
  const PointUm high = tip(rig);
  EXPECT_NEAR(mm(high.z - low.z), 100, 0.8);
  EXPECT_NEAR(mm(high.x - low.x), 0, 0.8);
  EXPECT_NEAR(mm(high.y - low.y), 0, 0.8);
  EXPECT_EQ(rig.state().stall, Stall::kNo);
  rig.travel('A', -1);
  ASSERT_FALSE(rig.state().held);
  EXPECT_EQ(rig.state().blocks[held].centroid_um, high);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i != held) EXPECT_EQ(rig.state().blocks[i], before[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, Picks, testing::ValuesIn(kPicks), pick_name);

}  // namespace
}  // namespace xr3
