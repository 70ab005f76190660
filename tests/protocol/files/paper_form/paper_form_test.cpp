// The paper's plain form: conversion of shipped and of random files in both directions is lossless;
// hand-written files have only what the paper names; errors have line numbers.
#include "protocol/files/paper_form/paper_form.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/json/text.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

const std::vector<std::string> kPaperWorkcells = {"rhino-xr3", "rhino-hundred", "adept-one",
                                                  "intelledex-660"};

/// Only the items that the paper names, as a student would type them.
const std::string kArm =
    "* a planar arm\n"
    "2\n"
    "* shoulder: theta d a alpha jvar\n"
    "0\n100\n200\n0\n1\n"
    "* precision, limits, speed, switch, mask, direction, label\n"
    "0.1\n-90 90\n100\n-20\n2\n1\nC\n"
    "* a slide\n"
    "0\n50\n0\n180\n2\n"
    "0.5\n0 100\n+120\n10\n1\n-1\nB\n"
    "* tool\n"
    "1\n0.5\n60\n0 80\n40\n2\nA\n"
    "0\n"
    "* links\n"
    "3\n7 2\n1 0 0 0\n0 0 0 100\n3 0\n4 1\n1 0 0 -.5\n"
    "* coupling, region, net roll\n"
    "1\n1 -2\n300 50\n1\n";

const std::string kTable =
    "* workspace\n600 500 700\n* blocks\n2\n"
    "64 32 40 262 0 20 90\n60 28 30 344 -92 15 140\n"
    "* camera\n290 0 1000\n384 384\n192 192\n";

/// The text with its line `number`, from 1, replaced.
std::string with_line(std::string text, int number, const std::string& line) {
  std::size_t begin = 0;
  for (int i = 1; i < number; ++i) begin = text.find('\n', begin) + 1;
  return text.replace(begin, text.find('\n', begin) - begin, line);
}

/// The lines and pointers of all findings, as "4 /blocks, 7 /camera/pixels/0".
std::string places(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += (text.empty() ? "" : ", ") + std::to_string(finding.line) + " " + finding.pointer;
  }
  return text;
}

CheckResult check(const std::string& text) {
  return check_either_form(text, "folder/lab.txt", Profile::kPaper);
}

TEST(PaperForm, ShippedRobotsRoundTrip) {
  for (const std::string& name : test::kShippedRobots) {
    const Robot& robot = test::robot_named(name);
    const std::string text = robot_to_paper_form(robot);
    const FileReading<Robot> reading = read_paper_robot(text, name);
    EXPECT_EQ(to_text(reading.findings), "");
    ASSERT_TRUE(reading.value);
    EXPECT_EQ(*reading.value, robot);
    EXPECT_EQ(robot_to_paper_form(*reading.value), text);
    EXPECT_EQ(check(text).kind, DataKind::kRobot);
  }
}

TEST(PaperForm, ShippedWorkcellsRoundTrip) {
  for (const std::string& name : kPaperWorkcells) {
    const Workcell& workcell = test::workcell_named(name);
    const std::string text = workcell_to_paper_form(workcell);
    const FileReading<Workcell> reading = read_paper_workcell(text, name);
    EXPECT_EQ(to_text(reading.findings), "");
    ASSERT_TRUE(reading.value);
    EXPECT_EQ(*reading.value, workcell);
    EXPECT_EQ(check(text).kind, DataKind::kWorkcell);
  }
}

TEST(PaperForm, OddRobotsRoundTrip) {
  Robot robot = test::robot_named("intelledex-660");
  robot.joints[0].drive.microswitch.width = 60;
  robot.tool.drive.microswitch.width = 7;
  robot.tool.drive.home = 31.25;
  robot.name = "say \"\\\" \xC3\xA9\n* no comment";
  robot.notes = "two\nlines\n*+ \"name\": 3";
  robot.links.clear();
  robot.couplings.clear();
  robot.net_roll.clear();
  const FileReading<Robot> reading = read_paper_robot(robot_to_paper_form(robot), "f");
  EXPECT_EQ(to_text(reading.findings), "");
  EXPECT_TRUE(reading.value == robot);
}

TEST(PaperForm, EveryArmRoundTrips) {
  for (int joints = 1; joints <= kMaxJoints; ++joints) {
    Robot robot = test::odd_arm(joints);
    const FileReading<Robot> as_json = read_robot(robot_to_json(robot).dump(), "f");
    ASSERT_TRUE(as_json.value) << to_text(as_json.findings);
    const FileReading<Robot> reading = read_paper_robot(robot_to_paper_form(*as_json.value), "f");
    EXPECT_EQ(to_text(reading.findings), "");
    EXPECT_TRUE(reading.value == as_json.value) << joints;
  }
}

double any_number() {
  const double mantissa = static_cast<double>(*rc::gen::inRange(-1000000000, 1000000000));
  return mantissa / static_cast<double>(*rc::gen::inRange(100000, 1000000000));
}

std::vector<OutlinePoint> any_points() {
  std::vector<OutlinePoint> points(*rc::gen::inRange<std::size_t>(0, 6));
  for (OutlinePoint& point : points) {
    point.draw = &point != points.data() && *rc::gen::arbitrary<bool>();
    point.p_mm = {any_number(), any_number(), any_number()};
  }
  return points;
}

std::string any_text(std::size_t least) {
  auto letters = *rc::gen::container<std::string>(
      rc::gen::elementOf(std::string("abc XYZ019*+\"\\\n\t/{}:,#")));
  letters.resize(std::min<std::size_t>(letters.size(), 40), ' ');
  return letters.size() < least ? "x" : letters;
}

/// A shipped robot with random changes that the rules allow.
Robot any_robot() {
  Robot robot = test::robot_named(*rc::gen::elementOf(test::kShippedRobots));
  robot.name = any_text(1);
  robot.notes = any_text(0);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    robot.joints[i].name = any_text(1).substr(0, 30) + std::to_string(i);
    robot.joints[i].dh.a_mm += any_number() / 100;
    robot.joints[i].drive.speed_counts_per_s = *rc::gen::inRange(1, 256);
  }
  robot.tool.drive.home -= std::abs(any_number()) / 10000;
  for (Outline& link : robot.links) {
    link = {*rc::gen::inRange(0, 16), any_points()};
  }
  for (ToolPart& part : robot.tool.parts) part.points = any_points();
  robot.net_roll_offset_deg = any_number();
  return robot;
}

RC_GTEST_PROP(PaperForm, AnyRobotRoundTrips, ()) {
  const FileReading<Robot> as_json = read_robot(robot_to_json(any_robot()).dump(), "f");
  RC_PRE(as_json.value.has_value());
  const FileReading<Robot> reading = read_paper_robot(robot_to_paper_form(*as_json.value), "f");
  RC_ASSERT(to_text(reading.findings) == "");
  RC_ASSERT(reading.value == as_json.value);
}

Micrometres any_um(Micrometres least) { return *rc::gen::inRange<Micrometres>(least, 2000000); }

Block any_block(std::size_t index) {
  Block block;
  block.name = any_text(0).substr(0, 30) + std::to_string(index);
  block.size_um = {any_um(1), any_um(1), any_um(1)};
  block.centroid_um = {any_um(-2000000), any_um(-2000000), any_um(-2000000)};
  block.yaw_udeg = *rc::gen::inRange<Microdegrees>(-179999999, 180000001);
  block.color = *rc::gen::inRange(0, 16);
  return block;
}

Workcell any_workcell() {
  Workcell workcell;
  workcell.name = any_text(1);
  workcell.notes = any_text(0);
  workcell.workspace = {any_um(1), any_um(1), any_um(1)};
  workcell.work_surface_um = workcell.workspace.z_um - any_um(1);
  workcell.surface_stalls = *rc::gen::arbitrary<bool>();
  for (std::size_t i = *rc::gen::inRange<std::size_t>(0, 5); i-- > 0;) {
    workcell.blocks.edit().push_back(any_block(i));
  }
  if (*rc::gen::arbitrary<bool>()) {
    const Micrometres height = workcell.work_surface_um + 5000000;
    const bool is_perspective = *rc::gen::arbitrary<bool>();
    workcell.camera = Camera{{any_um(-2000000), any_um(-2000000), height},
                             any_um(1),
                             any_um(1),
                             *rc::gen::inRange(1, 2049),
                             *rc::gen::inRange(1, 2049),
                             is_perspective ? Projection::kPerspective : Projection::kOrthographic};
  }
  return workcell;
}

RC_GTEST_PROP(PaperForm, AnyWorkcellRoundTrips, ()) {
  const Workcell workcell = any_workcell();
  RC_PRE(read_workcell(workcell_to_json(workcell).dump(), "f").value.has_value());
  const FileReading<Workcell> reading = read_paper_workcell(workcell_to_paper_form(workcell), "f");
  RC_ASSERT(!has_errors(reading.findings));
  RC_ASSERT(reading.value == workcell);
}

TEST(PaperForm, ReadsARobotWithOnlyThePapersItems) {
  const CheckResult result = check(kArm);
  EXPECT_EQ(to_text(result.findings), "");
  ASSERT_TRUE(result.robot);
  const Robot& arm = *result.robot;
  EXPECT_EQ(arm.name, "lab");
  ASSERT_EQ(arm.joints.size(), 2U);
  EXPECT_EQ(arm.joints[0].dh, (DhRow{0, 100, 200, 0}));
  EXPECT_EQ(arm.joints[0].name, "joint 1");
  EXPECT_EQ(arm.joints[1].variable, JointVariable::kD);
  EXPECT_EQ(arm.joints[1].drive, (Drive{'B', 0.5, 0, 100, 50, 120, -1, {10, 1, {}, {}}}));
  EXPECT_EQ(arm.tool.drive, (Drive{'A', 0.5, 0, 80, 60, 60, 1, {40, 2, {}, {}}}))
      << "wide open, 80 mm, where the switch closes 40 counts from the home";
  ASSERT_EQ(arm.links.size(), 3U);
  EXPECT_EQ(arm.links[0].points[1], (OutlinePoint{true, {0, 0, 100}}));
  EXPECT_EQ(arm.couplings, (std::vector<Coupling>{{0, 1, -1}}));
  EXPECT_EQ(arm.protected_region, (ProtectedRegion{50, 300}));
  EXPECT_EQ(arm.net_roll, (std::vector<RollTerm>{{0, 1}}));
}

TEST(PaperForm, AngularJawsGetTheirHingeFromTheirParts) {
  const std::string angular = with_line(kArm, 31, "2");
  std::string text = with_line(with_line(angular, 34, "0 60"), 38, "1\n1 9 2\n1 0 0 0\n0 0 -5 -62");
  text = with_line(text, 35, "10");
  const CheckResult result = check(text);
  ASSERT_TRUE(result.robot) << to_text(result.findings);
  EXPECT_EQ(result.robot->tool.finger_length_mm, 62);
  EXPECT_EQ(result.robot->tool.parts[0].pivot_mm, (PointMm{0, 0, -62}));
  EXPECT_EQ(result.robot->tool.drive.home, 55);
}

TEST(PaperForm, ReadsAWorkcellWithOnlyThePapersItems) {
  const CheckResult result = check(kTable);
  EXPECT_EQ(to_text(result.findings), "");
  ASSERT_TRUE(result.workcell);
  const Workcell& cell = *result.workcell;
  EXPECT_EQ(cell.name, "lab");
  EXPECT_EQ(cell.workspace, (Workspace{600000, 500000, 700000}));
  ASSERT_EQ(cell.blocks.size(), 2U);
  EXPECT_EQ(cell.blocks[1],
            (Block{"block 2", {60000, 28000, 30000}, {344000, -92000, 15000}, 140000000, 10}));
  ASSERT_TRUE(cell.camera);
  EXPECT_EQ(*cell.camera,
            (Camera{{290000, 0, 1000000}, 384000, 384000, 192, 192, Projection::kOrthographic}));
}

TEST(PaperForm, ReadsInchesAndDosLineEnds) {
  std::string dos =
      "*+ \"length_unit\": \"inch\", \"work_surface\": 1\r\n10 10 20\r\n0\r\n\x1A junk";
  const CheckResult result = check(dos);
  ASSERT_TRUE(result.workcell) << to_text(result.findings);
  EXPECT_EQ(result.workcell->workspace.x_um, 254000);
  EXPECT_EQ(result.workcell->work_surface_um, 25400);
  EXPECT_FALSE(result.workcell->camera);
}

TEST(PaperForm, AdditionsApplyToTheNextLine) {
  const CheckResult result = check(
      "1 1 1\n*+++ decoration +++\n2\n*+ \"block\": \"red\"\n* remark\n*+ \"color\": 12\n"
      ".1 .1 .1 .5 0 .05 0\n*+ \"name\": \"lab 7\"\n.1 .1 .1 .2 0 .05 0\n");
  ASSERT_TRUE(result.workcell) << to_text(result.findings);
  EXPECT_EQ(result.workcell->name, "lab 7");
  EXPECT_EQ(result.workcell->blocks[0].name, "red");
  EXPECT_EQ(result.workcell->blocks[0].color, 12);
  EXPECT_EQ(result.workcell->blocks[1].name, "block 2");
}

struct Broken {
  std::string name;
  std::string text;
  std::string places;
  std::string words;  ///< part of the report
};

TEST(PaperForm, ReportsErrorsOfWorkcellsWithTheirLines) {
  const Broken rows[] = {
      {"a word for a number", with_line(kTable, 2, "600 wide 700"), "2 /workspace/y",
       "found \"wide\"; allowed: a length above 0, up to 100000 mm"},
      {"two at once", with_line(with_line(kTable, 5, "64 0 40 262 0 20 90"), 10, "192 9999"),
       "5 /blocks/0/size/1, 10 /camera/pixels/1", "found 9999"},
      {"not a number", with_line(kTable, 5, "64 32 40 262 nan inf 1e999"),
       "5 /blocks/0/centroid/1, 5 /blocks/0/centroid/2, 5 /blocks/0/yaw_deg", "\"nan\""},
      {"an item missing", with_line(kTable, 5, "64 32 40 262 0 20"), "5 /blocks/0",
       "found \"64 32 40 262 0 20\"; allowed: 7 items: block"},
      {"a block too many", with_line(kTable, 4, "1"), "6 /camera/location, 8 /camera/field",
       "(the rest of the file was not read)"},
      {"a block too few", with_line(kTable, 4, "3"), "8 /blocks/2, 9 /camera/location", "7 items"},
      {"no count", with_line(kTable, 4, "some"), "4 /blocks",
       "a whole number 0 to 256 (the rest of the file was not read)"},
      {"a wild count", with_line(kTable, 4, "1e9"), "4 /blocks", "found 1"},
      {"cut off", kTable.substr(0, kTable.find("384")), "8 /camera/field",
       "found the end of the file; allowed: camera's field of view"},
      {"too long", kTable + "1 2\n3\n", "11 ", "and more lines; allowed: nothing more"},
      {"unknown addition", "*+ \"work_surfac\": 3\n" + kTable, "1 /work_surfac",
       "perhaps \"work_surface\" was meant"},
      {"addition twice", "*+ \"name\": \"a\"\n*+ \"name\": \"b\"\n" + kTable, "2 /name",
       "a duplicate"},
      {"addition twice in a line", "*+ \"name\": \"a\", \"name\": \"b\"\n" + kTable, "1 /name",
       "a duplicate"},
      {"wrong addition", "*+ \"surface_stalls\": 1\n" + kTable, "1 /surface_stalls",
       "found 1; allowed: true or false"},
      {"no addition", "*+ name = lab\n" + kTable, "1 ", "members as in the JSON file"},
      {"a deep addition", "*+ \"name\": [[[[1]]]]\n" + kTable, "1 ", "members as in the JSON file"},
      {"rules", with_line(kTable, 8, "290 0 -1"), "8 /camera/location/2", "above the work surface"},
  };
  for (const Broken& row : rows) {
    SCOPED_TRACE(row.name);
    const CheckResult result = check(row.text);
    EXPECT_EQ(places(result.findings), row.places);
    EXPECT_NE(to_text(result.findings).find(row.words), std::string::npos)
        << to_text(result.findings);
    EXPECT_EQ(to_text(result.findings).find("folder/lab.txt:"), 0U);
    EXPECT_FALSE(result.workcell);
  }
}

TEST(PaperForm, ReportsErrorsOfRobotsWithTheirLines) {
  const Broken rows[] = {
      {"too many axes", with_line(kArm, 2, "9"), "2 /joints", "a whole number 1 to 7"},
      {"no axes", with_line(kArm, 2, "0"), "2 /joints", ""},
      {"jvar", with_line(kArm, 8, "3"), "8 /joints/0/variable",
       "found 3; allowed: 1 (theta) or 2 (d)"},
      {"limits", with_line(kArm, 11, "-90"), "11 /joints/0/limits", "2 items: limits"},
      {"limits the wrong way", with_line(kArm, 11, "90 -90"), "11 /joints/0/limits",
       "the lower limit first"},
      {"home past a limit", with_line(kArm, 4, "95"), "4 /joints/0/theta_deg", "within the limits"},
      {"label", with_line(kArm, 16, "A"), "16 /joints/0/label",
       "found \"A\"; allowed: a letter \"B\""},
      {"labels", with_line(kArm, 29, "C"), "29 /joints/1/label", "found \"C\", a duplicate"},
      {"a number for a label", with_line(kArm, 16, "7"), "16 /joints/0/label", "one item: label"},
      {"mask", with_line(kArm, 14, "3"), "14 /joints/0/switch/mask", "1, 2, 4, 8, 16 or 32"},
      {"pen", with_line(kArm, 42, "2 0 0 0"), "42 /links/0/points/0/0", "1 (move) or 0 (draw)"},
      {"first point drawn", with_line(kArm, 42, "0 0 0 0"), "42 /links/0/points/0", "\"move\""},
      {"links", with_line(kArm, 40, "2"), "40 /links, 45 /coupling", ""},
      {"coupled to itself", with_line(kArm, 49, "1 1"), "49 /coupling/0", "two different joints"},
      {"roll", with_line(kArm, 51, "2"), "51 /net_roll/0", "does not turn"},
  };
  for (const Broken& row : rows) {
    SCOPED_TRACE(row.name);
    const CheckResult result = check(row.text);
    EXPECT_EQ(places(result.findings), row.places) << to_text(result.findings);
    EXPECT_NE(to_text(result.findings).find(row.words), std::string::npos)
        << to_text(result.findings);
    EXPECT_FALSE(result.robot);
  }
}

// If any line is removed, duplicated or damaged, an error is reported at or after that line, and
// nothing is thrown.
TEST(PaperForm, ADamagedLineIsReportedAtOrAfterIt) {
  const std::string text = robot_to_paper_form(test::robot_named("adept-one"));
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += part + "\n";
    return text;
  };
  for (std::size_t i = 0; i < lines.size(); i += 19) {
    if (lines[i].starts_with("*")) continue;
    for (const bool doubled : {false, true}) {
      std::vector<std::string> spoilt = lines;
      const auto at = spoilt.begin() + static_cast<std::ptrdiff_t>(i);
      doubled ? void(spoilt.insert(at, lines[i])) : void(spoilt.erase(at));
      const CheckResult result = check(joined(spoilt));
      EXPECT_FALSE(result.is_good()) << i + 1 << ": " << lines[i];
    }
    std::vector<std::string> spoilt = lines;
    spoilt[i] = "\xFF?";
    EXPECT_FALSE(check(joined(spoilt)).is_good()) << i + 1;
  }
}

TEST(PaperForm, RejectsOtherText) {
  for (const std::string text : {"", "* nothing\n", "1 2\n", "\n\n1 2 3 4\n"}) {
    const CheckResult result = check(text);
    EXPECT_EQ(result.kind, DataKind::kUnknown);
    EXPECT_EQ(result.findings.size(), 1U);
  }
  EXPECT_EQ(places(check("* a\n\n1 2\n").findings), "3 ");
}

TEST(PaperForm, DistinguishesJsonFromThePlainForm) {
  EXPECT_TRUE(is_json_form("* comment\n  {"));
  EXPECT_TRUE(is_json_form("[1]"));
  EXPECT_TRUE(is_json_form("\xFF\xFE*")) << "in UTF-16";
  EXPECT_FALSE(is_json_form("* {\n5\n"));
  EXPECT_FALSE(is_json_form(""));
  EXPECT_TRUE(check(test::project_file("data/robots/rhino-xr3.json")).robot);
}

TEST(JsonText, RoundTripsInShortLines) {
  for (const std::string& name : test::kShippedRobots) {
    const std::string text = json_text(robot_to_json(test::robot_named(name)));
    EXPECT_EQ(load_robot(text, name), test::robot_named(name));
    EXPECT_NE(text.find("\n  \"joints\": [\n    {\n      \"label\": "), std::string::npos);
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
      const std::string line = text.substr(begin, text.find('\n', begin) - begin);
      if (line.starts_with("  \"notes\": ")) continue;  // a text cannot be divided
      EXPECT_LE(line.size(), 120U) << line;
    }
  }
}

TEST(JsonText, ShortValuesFitOnOneLine) {
  EXPECT_EQ(json_text(Json::parse(R"({"a": [1, 2.5], "b": {"c": "d", "e": []}})")),
            "{\n  \"a\": [1, 2.5],\n  \"b\": {\"c\": \"d\", \"e\": []}\n}\n");
}

}  // namespace
}  // namespace xr3
