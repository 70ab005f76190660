// The empty table of a robot without a workcell: it suits the robot and is a valid workcell file.
#include "core/inverse/empty_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/files/workcell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

Workcell table_of(const Robot& robot) { return empty_table(Reach(robot)); }

TEST(EmptyTable, HasNoBlocksAndNoCamera) {
  const Workcell table = table_of(test::robot_named("rhino-xr3"));
  EXPECT_EQ(table.name, "empty table");
  EXPECT_TRUE(table.blocks.empty());
  EXPECT_FALSE(table.camera.has_value());
  EXPECT_FALSE(table.surface_stalls);
}

TEST(EmptyTable, IsALittleLargerThanTheReach) {
  const Workcell table = table_of(test::robot_named("rhino-xr3"));
  EXPECT_EQ(table.workspace, (Workspace{600'000, 500'000, 700'000}));
  EXPECT_EQ(table.work_surface_um, 0);
}

TEST(EmptyTable, TheHandReachesItsSurface) {
  const Workcell table = table_of(test::robot_named("adept-one"));
  const double surface = mm(table.work_surface_um);
  EXPECT_GT(surface, 0) << "the quill of the Adept does not reach the base plane";
  EXPECT_TRUE(Reach(test::robot_named("adept-one")).furthest_mm(surface + 20).has_value());
  EXPECT_FALSE(Reach(test::robot_named("adept-one")).furthest_mm(surface - 30).has_value());
}

TEST(EmptyTable, WithoutAClosedFormItsSizeIsAnUpperBoundOfTheReach) {
  const Robot robot = test::odd_arm(7);
  ASSERT_FALSE(Reach(robot).is_quick());
  const Workcell table = table_of(robot);
  EXPECT_EQ(table.work_surface_um, 0);
  EXPECT_GE(mm(table.workspace.x_um), Reach(robot).most_mm());
}

/// Any robot has a table that a recording can keep: lengths above 0 and within the limits of files.
TEST(EmptyTable, IsAValidWorkcellForTheLongestAndTheShortestArm) {
  Robot robot = test::robot_named("rhino-xr3");
  for (const double length : {0.0, 1e5}) {
    for (Joint& joint : robot.joints) joint.dh.a_mm = joint.dh.d_mm = length;
    const Workcell table = table_of(robot);
    EXPECT_EQ(load_workcell(workcell_to_json(table).dump(), "table"), table) << length;
  }
}

}  // namespace
}  // namespace xr3
