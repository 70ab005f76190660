// The shipped robots as read by the loader, and round trips of robot files.
#include "protocol/files/robot.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "protocol/files/consistency.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

std::string robot_file(const std::string& name) { return "data/robots/" + name + ".json"; }

Robot shipped(const std::string& name) {
  return load_robot(test::project_file(robot_file(name)), robot_file(name));
}

struct CountRow {
  std::string robot;
  char label;
  Counts low;
  Counts high;
};

TEST(RobotJson, LimitsOfAllDrivesInCounts) {
  const CountRow rows[] = {
      {"rhino-xr3", 'F', -771, 771},         {"rhino-xr3", 'E', -440, 881},
      {"rhino-xr3", 'D', -660, 925},         {"rhino-xr3", 'C', -1101, 1101},
      {"rhino-xr3", 'B', -1151712, 1152288}, {"rhino-xr3", 'A', -16, 64},
      {"adept-one", 'E', -1500, 1500},       {"adept-one", 'D', -1470, 1470},
      {"adept-one", 'C', -200, 190},         {"adept-one", 'B', -1174, 598},
      {"adept-one", 'A', -40, 120},          {"intelledex-660", 'G', -1500, 1500},
      {"intelledex-660", 'F', -1500, 1500},  {"intelledex-660", 'E', -1200, 1200},
      {"intelledex-660", 'D', -1500, 1500},  {"intelledex-660", 'C', -1200, 1200},
      {"intelledex-660", 'B', -1152, 1152},  {"intelledex-660", 'A', -40, 80},
  };
  for (const CountRow& row : rows) {
    SCOPED_TRACE(row.robot + " " + row.label);
    const Model model(shipped(row.robot), Workcell{}, Profile::kPaper);
    const MotorModel& motor = model.motor(model.index_of(row.label));
    EXPECT_EQ(motor.low, row.low);
    EXPECT_EQ(motor.high, row.high);
  }
}

TEST(RobotJson, AMountIsReadAndWritten) {
  const Robot robot = test::on_slide(test::robot_named("rhino-xr3"));
  const Json json = robot_to_json(robot);
  EXPECT_EQ(json["mount"], (Json{{"theta_deg", 0}, {"d", 0}, {"a", 0}, {"alpha_deg", -90}}));
  EXPECT_EQ(load_robot(json.dump(), "slide.json"), robot);
  EXPECT_FALSE(robot_to_json(test::robot_named("rhino-xr3")).contains("mount"));
}

TEST(RobotJson, ShippedFilesHaveNoFindings) {
  for (const std::string& name : test::kShippedRobots) {
    const FileReading<Robot> reading = read_robot(test::project_file(robot_file(name)), name);
    EXPECT_EQ(to_text(reading.findings), "");
    EXPECT_TRUE(reading.value.has_value());
  }
}

TEST(RobotJson, ReadsEveryFieldOfTheRhino) {
  const Robot robot = shipped("rhino-xr3");
  ASSERT_EQ(robot.joints.size(), 5U);
  const Joint& elbow = robot.joints[2];
  EXPECT_EQ(elbow.name, "elbow");
  EXPECT_EQ(elbow.variable, JointVariable::kTheta);
  EXPECT_EQ(elbow.dh, (DhRow{90, 0, 228.6, 0}));
  EXPECT_EQ(elbow.drive, (Drive{'D', 0.1135, -15, 165, 90, 160, -1, {40, 2, {}, {}}}));
  EXPECT_EQ(robot.tool.kind, ToolKind::kParallel);
  EXPECT_EQ(robot.tool.drive, (Drive{'A', 0.79375, 0, 63.5, 50.8, 60, -1, {-16, 16, {}, {}}}));
  EXPECT_EQ(robot.tool.parts.size(), 2U);
  EXPECT_EQ(robot.couplings, (std::vector<Coupling>{{1, 2, -1}, {2, 3, -1}}));
  EXPECT_EQ(robot.protected_region, (ProtectedRegion{100, 340}));
  EXPECT_EQ(robot.net_roll, (std::vector<RollTerm>{{0, 1}, {4, -1}}));
  EXPECT_EQ(robot.net_roll_offset_deg, 0);
}

TEST(RobotJson, ReadsPrismaticJointsAndAngularJaws) {
  const Joint vertical = shipped("adept-one").joints[2];
  EXPECT_EQ(vertical.variable, JointVariable::kD);
  EXPECT_EQ(vertical.drive.home, 100);
  const Robot intelledex = shipped("intelledex-660");
  EXPECT_EQ(intelledex.tool.kind, ToolKind::kAngular);
  EXPECT_EQ(intelledex.tool.finger_length_mm, 60);
  EXPECT_EQ(intelledex.tool.parts.front().pivot_mm, (PointMm{0, 0, -60}));
  EXPECT_EQ(intelledex.net_roll_offset_deg, -90);
}

TEST(RobotJson, ReadsACarousel) {
  const Robot robot = shipped("rhino-xr3-accessories");
  ASSERT_TRUE(robot.carousel.has_value());
  EXPECT_EQ(robot.carousel->drive.label, 'H');
  EXPECT_EQ(robot.carousel->x_mm, 330);
  EXPECT_EQ(robot.carousel->height_mm, 40);
  EXPECT_FALSE(shipped("rhino-xr3").carousel.has_value());
}

TEST(RobotJson, ReadsACarouselInInches) {
  Json json = robot_to_json(shipped("rhino-xr3-accessories"));
  json["length_unit"] = "inch";
  json["carousel"].update({{"center", {10, -2}}, {"radius", 4}, {"height", 1}});
  // Only the carousel matters: the lengths of the arm are now 25.4 times longer.
  const FileReading<Robot> reading = read_robot(json.dump(), "f");
  ASSERT_TRUE(reading.value.has_value()) << to_text(reading.findings);
  const Carousel& carousel = *reading.value->carousel;
  EXPECT_NEAR(carousel.x_mm, 254, 1e-9);
  EXPECT_NEAR(carousel.y_mm, -50.8, 1e-9);
  EXPECT_NEAR(carousel.radius_mm, 101.6, 1e-9);
  EXPECT_NEAR(carousel.height_mm, 25.4, 1e-9);
  EXPECT_EQ(carousel.drive.precision, 0.3125) << "an angle";
}

TEST(RobotJson, EveryFrameHasAnOutline) {
  for (const std::string& name : test::kShippedRobots) {
    const Robot robot = shipped(name);
    ASSERT_EQ(robot.links.size(), robot.joints.size() + 1);
    for (const Outline& link : robot.links) EXPECT_GT(link.points.size(), 10U) << name;
    EXPECT_EQ(robot.tool.parts.size(), 2U);
  }
}

// Angular fingers open by a right-handed turn of side * angle / 2 about x, which moves points in
// front of the hinge, along the approach, towards -y: the finger that closes from there has the
// side +1.
TEST(RobotJson, FingersTouchWhenTheJawsAreClosed) {
  for (const std::string& name : test::kShippedRobots) {
    const Tool tool = shipped(name).tool;
    const double opens = tool.kind == ToolKind::kParallel ? 1 : -1;
    for (const ToolPart& part : tool.parts) {
      for (const OutlinePoint& point : part.points) {
        EXPECT_GE(point.p_mm.y * part.side * opens, 0) << name;
      }
    }
  }
}

TEST(RobotJson, RoundTrip) {
  for (const std::string& name : test::kShippedRobots) {
    const Robot robot = shipped(name);
    const Json json = robot_to_json(robot);
    EXPECT_EQ(load_robot(json.dump(2), name), robot);
    EXPECT_EQ(robot_to_json(load_robot(json.dump(), name)), json);
  }
}

TEST(RobotJson, WritesTheMembersOfTheShippedFiles) {
  for (const std::string& name : test::kShippedRobots) {
    const std::string text = test::project_file(robot_file(name));
    EXPECT_EQ(robot_to_json(shipped(name)).dump(), Json::parse(text).dump());
  }
}

TEST(RobotJson, RoundTripKeepsWidthsAndSigns) {
  Robot robot = shipped("rhino-xr3");
  robot.joints[0].drive.microswitch = {0, 8, 60, {}};
  robot.couplings = {{0, 1, 1}, {0, 4, -1}};
  robot.links.clear();
  robot.notes.clear();
  EXPECT_EQ(load_robot(robot_to_json(robot).dump(), "f"), robot);
}

Json in_inches(const Robot& robot) {
  Json json = robot_to_json(robot);
  json["length_unit"] = "inch";
  return json;
}

TEST(RobotJson, ConvertsInchesOnce) {
  const Robot adept = shipped("adept-one");
  const Robot inches = load_robot(in_inches(adept).dump(), "f");
  EXPECT_DOUBLE_EQ(inches.joints[0].dh.d_mm, 877 * 25.4);
  EXPECT_EQ(inches.joints[0].drive, adept.joints[0].drive) << "angles stay";
  EXPECT_DOUBLE_EQ(inches.joints[2].drive.precision, 0.5 * 25.4);
  EXPECT_DOUBLE_EQ(inches.joints[2].drive.max, 195 * 25.4);
  EXPECT_DOUBLE_EQ(inches.joints[2].drive.home, 100 * 25.4);
  EXPECT_DOUBLE_EQ(inches.tool.drive.max, 80 * 25.4);
  EXPECT_DOUBLE_EQ(inches.protected_region.radius_mm, 300 * 25.4);
  EXPECT_DOUBLE_EQ(inches.links[0].points[1].p_mm.x, adept.links[0].points[1].p_mm.x * 25.4);
}

TEST(RobotJson, HardHomeCountsCoupling) {
  const Model model(shipped("rhino-xr3"), Workcell{}, Profile::kPaper);
  const Positions at = hard_home(model);
  EXPECT_EQ(at[0], 30);
  EXPECT_EQ(at[1], -40);
  EXPECT_EQ(at[2], 40 + -40) << "the shoulder carries the elbow along";
}

TEST(RobotJson, MembersWithDefaultsMayBeOmitted) {
  Json whole = robot_to_json(shipped("rhino-xr3"));
  for (const char* member :
       {"links", "coupling", "protected_region", "net_roll", "net_roll_offset_deg"})
    EXPECT_EQ(whole.erase(member), 1U) << member << " is always written";
  EXPECT_EQ(whole["tool"].erase("parts"), 1U);
  const Robot robot = load_robot(whole.dump(), "arm.json");
  EXPECT_TRUE(robot.links.empty() && robot.couplings.empty() && robot.net_roll.empty());
  EXPECT_TRUE(robot.tool.parts.empty());
  EXPECT_EQ(robot.protected_region, ProtectedRegion{});
  EXPECT_EQ(robot.net_roll_offset_deg, 0);
}

TEST(RobotJson, AWorkcellCausesOneSentence) {
  const FileReading<Robot> reading = read_robot(R"({"length_unit": "cm", "blocks": []})", "w.json");
  EXPECT_EQ(to_text(reading.findings),
            "w.json:1: found a workcell; allowed: a robot, with \"joints\" and \"tool\"\n");
}

TEST(RobotJson, LoadThrowsWithAllFindings) {
  try {
    load_robot("{\"length_unit\": \"mm\"}", "arm.json");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_EQ(error.findings().size(), 3U) << error.what();
    EXPECT_NE(std::string(error.what()).find("arm.json:1: /joints: is missing"), std::string::npos);
  }
}

}  // namespace
}  // namespace xr3
