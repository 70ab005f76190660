// The shipped workcells as read by the loader, round trips of workcell files, and warnings.
#include "protocol/files/workcell.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/files/robot.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

const std::vector<std::string> kWorkcells = {"rhino-xr3", "rhino-hundred", "adept-one",
                                             "intelledex-660", "rhino-xr3-accessories"};

std::string workcell_text(const std::string& name) {
  return test::project_file("data/workcells/" + name + ".json");
}

Robot robot_for(const std::string& workcell) {
  const std::string name = workcell == "rhino-hundred" ? "rhino-xr3" : workcell;
  return load_robot(test::project_file("data/robots/" + name + ".json"), name);
}

/// A workcell with these blocks, its surface at z = 100 mm.
std::string with_blocks(const std::string& blocks) {
  return "{\"name\": \"w\", \"length_unit\": \"mm\",\n"
         "\"workspace\": {\"x\": 600, \"y\": 500, \"z\": 700}, \"work_surface\": 100,\n"
         "\"blocks\": [\n" +
         blocks + "]}";
}

std::string block(const std::string& name, const std::string& size, const std::string& centroid,
                  int yaw_deg = 0) {
  return "{\"name\": \"" + name + "\", \"size\": " + size + ", \"centroid\": " + centroid +
         ", \"yaw_deg\": " + std::to_string(yaw_deg) + ", \"color\": 1}";
}

TEST(WorkcellJson, ShippedFilesHaveNoFindings) {
  for (const std::string& name : kWorkcells) {
    const Robot robot = robot_for(name);
    const FileReading<Workcell> reading = read_workcell(workcell_text(name), name, &robot);
    EXPECT_EQ(to_text(reading.findings), "");
    EXPECT_TRUE(reading.value.has_value());
  }
}

// Without the robot, the blocks on its carousel float.
TEST(WorkcellJson, TheCarouselOfTheRobotCarriesBlocks) {
  const std::string text = workcell_text("rhino-xr3-accessories");
  const std::string floating = to_text(read_workcell(text, "f").findings);
  EXPECT_NE(floating.find("a block that floats 40 mm above the work surface"), std::string::npos);
  Robot robot = robot_for("rhino-xr3-accessories");
  robot.carousel->height_mm = 50;
  const std::string sunk = to_text(read_workcell(text, "f", &robot).findings);
  EXPECT_NE(sunk.find("a block that reaches 10 mm under the carousel's top"), std::string::npos);
}

TEST(WorkcellJson, ReadsEveryField) {
  const Workcell cell = load_workcell(workcell_text("adept-one"), "f");
  EXPECT_EQ(cell.workspace, (Workspace{900000, 800000, 1000000}));
  EXPECT_EQ(cell.work_surface_um, 500000);
  EXPECT_FALSE(cell.surface_stalls);
  ASSERT_EQ(cell.blocks.size(), 5U);
  EXPECT_EQ(cell.blocks[2],
            (Block{"blue", {70000, 40000, 30000}, {620000, -150000, 515000}, 115000000, 9}));
  ASSERT_TRUE(cell.camera.has_value());
  EXPECT_EQ(*cell.camera,
            (Camera{{540000, 0, 1500000}, 480000, 480000, 192, 192, Projection::kOrthographic}));
}

TEST(WorkcellJson, AHundredBlocks) {
  const Workcell cell = load_workcell(workcell_text("rhino-hundred"), "f");
  ASSERT_EQ(cell.blocks.size(), 100U);
  EXPECT_EQ(cell.blocks[37].centroid_um, (PointUm{240000, 90000, 10000}));
  EXPECT_EQ(cell.blocks[37].yaw_udeg, 109000000);  // 37 * 37 modulo 180
}

TEST(WorkcellJson, RoundTrip) {
  for (const std::string& name : kWorkcells) {
    const Workcell cell = load_workcell(workcell_text(name), name);
    EXPECT_EQ(load_workcell(workcell_to_json(cell).dump(2), name), cell);
  }
}

TEST(WorkcellJson, RoundTripKeepsMissingMembers) {
  Workcell cell = load_workcell(workcell_text("rhino-xr3"), "f");
  cell.surface_stalls = true;
  cell.work_surface_um = 12345;
  cell.camera->projection = Projection::kPerspective;
  EXPECT_EQ(load_workcell(workcell_to_json(cell).dump(), "f"), cell);
  cell.camera.reset();
  cell.blocks = {};
  EXPECT_EQ(load_workcell(workcell_to_json(cell).dump(), "f"), cell);
}

TEST(WorkcellJson, ConvertsInchesToMicrometres) {
  Json json = Json::parse(workcell_text("rhino-xr3"));
  json["length_unit"] = "inch";
  const Workcell cell = load_workcell(json.dump(), "f");
  EXPECT_EQ(cell.workspace.x_um, 15240000);
  EXPECT_EQ(cell.blocks[0].centroid_um.x, 6654800);
  EXPECT_EQ(cell.camera->field_x_um, 9753600);
  EXPECT_EQ(cell.blocks[0].yaw_udeg, 90000000) << "angles stay";
}

TEST(WorkcellJson, NormalizesYawsToOneTurn) {
  const std::string text = with_blocks(block("a", "[10, 10, 10]", "[50, 0, 105]", 350) + ",\n" +
                                       block("b", "[10, 10, 10]", "[80, 0, 105]", -180));
  const Workcell cell = load_workcell(text, "f");
  EXPECT_EQ(cell.blocks[0].yaw_udeg, -10000000);
  EXPECT_EQ(cell.blocks[1].yaw_udeg, 180000000);
}

TEST(WorkcellJson, BoundsTheRowsOfTheCameraInRecordings) {
  Json json = Json::parse(workcell_text("rhino-xr3"));
  json["camera"]["pixels"] = {2048, 2048};
  Json block = json["blocks"][0];
  block["size"] = {2000, 2000, 1};
  json["blocks"].clear();
  const auto findings = [&](int blocks) {
    for (int i = static_cast<int>(json["blocks"].size()); i < blocks; ++i) {
      block["name"] = std::to_string(i);
      json["blocks"].push_back(block);
    }
    return read_workcell(json.dump(), "f", nullptr, 0, WorkcellBounds::kSaved).findings;
  };
  EXPECT_FALSE(has_errors(findings(244)));
  EXPECT_EQ(to_text(findings(245)),
            "f:1: /blocks: found blocks that take 501760 rows of the camera's image, each row "
            "counted for each block; allowed: at most 500000: fewer or smaller blocks, or fewer "
            "pixels\n");
}

struct WarningCase {
  std::string blocks;
  std::string warnings;
};

TEST(WorkcellJson, WarnsAboutOddBlocks) {
  const std::string on_table = block("a", "[60, 40, 20]", "[300, 0, 110]");
  const WarningCase cases[] = {
      {on_table, ""},
      {on_table + ",\n" + block("b", "[60, 40, 20]", "[300, 40, 110]"), ""},
      {on_table + ",\n" + block("b", "[60, 40, 20]", "[300, 39, 110]"),
       "f:5: warning: /blocks/1: found a block that overlaps \"a\"; allowed: blocks apart from "
       "each "
       "other\n"},
      {on_table + ",\n" + block("b", "[60, 20, 20]", "[355, 44, 110]", 45), ""},
      {on_table + ",\n" + block("b", "[60, 20, 20]", "[345, 27, 110]", 45),
       "f:5: warning: /blocks/1: found a block that overlaps \"a\"; allowed: blocks apart from "
       "each "
       "other\n"},
      {on_table + ",\n" + block("b", "[60, 40, 20]", "[310, 0, 130]", 30), ""},
      {on_table + ",\n" + block("b", "[60, 40, 20]", "[310, 0, 131]", 30),
       "f:5: warning: /blocks/1: found a block that floats 21 mm above the work surface\n"},
      {on_table + ",\n" + block("b", "[60, 40, 20]", "[400, 0, 130]"),
       "f:5: warning: /blocks/1: found a block that floats 20 mm above the work surface\n"},
      {block("a", "[60, 40, 20]", "[300, 0, 108]"),
       "f:4: warning: /blocks/0: found a block that reaches 2 mm under the work surface\n"},
      {block("a", "[60, 40, 20]", "[580, 0, 110]"),
       "f:4: warning: /blocks/0: found a block that is partly outside the workspace\n"},
      {block("a", "[60, 40, 20]", "[300, -490, 110]"),
       "f:4: warning: /blocks/0: found a block that is partly outside the workspace\n"},
      {block("a", "[80, 63.5, 20]", "[300, 0, 110]"),
       "f:4: warning: /blocks/0: found a block 63.5 mm wide; allowed: less than 63.5 mm, the jaws' "
       "widest opening\n"},
  };
  const Robot robot = robot_for("rhino-xr3");
  for (const WarningCase& expected : cases) {
    SCOPED_TRACE(expected.blocks);
    const FileReading<Workcell> reading = read_workcell(with_blocks(expected.blocks), "f", &robot);
    EXPECT_TRUE(reading.value.has_value()) << "warnings are no errors";
    const std::string text = to_text(reading.findings);
    const std::string beginning = expected.warnings.substr(0, expected.warnings.size() - 1);
    EXPECT_EQ(text.empty(), expected.warnings.empty()) << text;
    EXPECT_EQ(text.substr(0, beginning.size()), beginning);
  }
}

TEST(WorkcellJson, AngularJawsOpenByTheirAngle) {
  const Robot robot = robot_for("intelledex-660");
  const std::string text = with_blocks(block("a", "[80, 61, 20]", "[300, 0, 110]"));
  const FileReading<Workcell> reading = read_workcell(text, "f", &robot);
  ASSERT_EQ(reading.findings.size(), 1U);
  EXPECT_EQ(reading.findings[0].allowed, "less than 60 mm, the jaws' widest opening");
}

TEST(WorkcellJson, RecordingsMayHaveTenThousandBlocks) {
  std::string blocks;
  for (int i = 0; i < 10000; ++i) {
    const std::string at = "[" + std::to_string(5 + 4 * (i % 100)) + ", " +
                           std::to_string(4 * (i / 100) - 200) + ", 101]";
    blocks += (i > 0 ? ",\n" : "") + block(std::to_string(i), "[3, 2, 2]", at, i % 7);
  }
  const std::string text = with_blocks(blocks);
  EXPECT_EQ(to_text(read_workcell(text, "f", nullptr, 0, WorkcellBounds::kSaved).findings), "");
  EXPECT_TRUE(has_errors(read_workcell(text, "f").findings));
}

TEST(WorkcellJson, ReportsTenThousandInvalidBlocksInReasonableTime) {
  std::string blocks = "{}";
  for (int i = 1; i < 10000; ++i) blocks += ",{}";
  const Findings findings =
      read_workcell(with_blocks(blocks), "f", nullptr, 0, WorkcellBounds::kSaved).findings;
  ASSERT_EQ(findings.size(), kMaxFindings + 1);
  EXPECT_EQ(findings.back().more, 50'000 - kMaxFindings);
}

TEST(WorkcellJson, RejectsASizeThatRoundsToZero) {
  EXPECT_TRUE(read_workcell(with_blocks(block("a", "[0.0005, 1, 1]", "[9, 9, 101]")), "f").value);
  const auto reading = read_workcell(with_blocks(block("a", "[1, 1, 0.0004]", "[9, 9, 101]")), "f");
  ASSERT_EQ(reading.findings.size(), 1U);
  EXPECT_EQ(reading.findings[0].pointer, "/blocks/0/size/2");
}

}  // namespace
}  // namespace xr3
