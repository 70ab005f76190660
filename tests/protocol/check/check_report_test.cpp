// The report of `xr3 check` about a file: its kind, findings and summary.
#include "protocol/check/check_report.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/text/table.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

CheckResult check_file(const std::string& path, Profile profile = Profile::kPaper) {
  return check_text(test::project_file(path), path, profile);
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(CheckReport, RecognisesRobotsAndWorkcells) {
  const CheckResult robot = check_file("data/robots/rhino-xr3.json");
  EXPECT_EQ(robot.kind, DataKind::kRobot);
  EXPECT_TRUE(robot.is_good());
  EXPECT_TRUE(robot.robot && !robot.workcell);
  const CheckResult workcell = check_file("data/workcells/rhino-xr3.json");
  EXPECT_EQ(workcell.kind, DataKind::kWorkcell);
  EXPECT_TRUE(workcell.is_good());
  EXPECT_TRUE(workcell.workcell && !workcell.robot);
  EXPECT_EQ(check_text("{\"blocks\": []}", "f", Profile::kPaper).kind, DataKind::kWorkcell);
  EXPECT_EQ(check_text("{\"steps\": []}", "f", Profile::kPaper).kind, DataKind::kUnknown);
}

TEST(CheckReport, WithARobotTellsBlocksOutOfReach) {
  const Robot rhino = test::robot_named("rhino-xr3");
  const std::string path = "data/workcells/rhino-xr3.json";
  std::string text = test::project_file(path);
  EXPECT_EQ(to_text(check_text(text, path, Profile::kPaper, &rhino).findings), "");
  const std::string at = "\"centroid\": [330, 96, 15]";
  text.replace(text.find(at), at.size(), "\"centroid\": [560, 96, 15]");
  EXPECT_EQ(to_text(check_text(text, path, Profile::kPaper, &rhino).findings),
            path +
                ":10: warning: /blocks/1: found a block out of reach; allowed: a centre where "
                "Rhino XR-3 can hold it from straight above\n");
  EXPECT_EQ(to_text(check_text(text, path, Profile::kPaper).findings), "");
}

TEST(CheckReport, SummaryOfTheRhino) {
  const std::string text = check_file("data/robots/rhino-xr3.json").summary;
  const std::string lines[] = {
      "Rhino XR-3: 5 joints, parallel jaws",
      "  2  E shoulder          -90      0  228.6          0  theta",
      "  E shoulder    0.1135 deg      -440        881  -139.94 to 9.993 deg          110         "
      "+1",
      "  D elbow       0.1135 deg      -660        925  -14.987 to 164.91 deg         160         "
      "-1",
      "  E shoulder    -40 and below       4  I",
      "  A tool        -16 and below      16  J",
      "  B tool roll   -25 and below      32  J",
      "Coupling: motor E shoulder turns joint D elbow against its own",
      "Protected region: radius 100 mm, height 340 mm, about the base axis",
      "Net roll: + base - tool roll + 0 deg",
      "Jaws: open 0 to 63.5 mm, 50.8 mm at the soft home",
      "Soft home: tip (238.1, 0, 320.7) mm, approach (0, 0, -1), net roll 90 deg",
      "Hard home: F+30 E-40 D+40 C+40 B-25 A-16",
  };
  for (const std::string& line : lines) EXPECT_TRUE(has_line(text, line)) << line << "\n" << text;
}

TEST(CheckReport, TheProfileSetsTheRangeOfSwitches) {
  const std::string text = check_file("data/robots/rhino-xr3.json", Profile::kMark3).summary;
  EXPECT_TRUE(has_line(text, "  E shoulder    -100 to -40               4  I")) << text;
  EXPECT_TRUE(has_line(text, "  D elbow       40 to 100                 2  I")) << text;
  EXPECT_TRUE(has_line(text, "  B tool roll   -85 to -25, every 1152   32  J")) << text;
}

TEST(CheckReport, SummariesOfTheOtherRobots) {
  const std::string adept = check_file("data/robots/adept-one.json").summary;
  EXPECT_TRUE(has_line(adept, "Coupling: none")) << adept;
  EXPECT_NE(adept.find("0 to 195 mm"), std::string::npos) << adept;
  const std::string intelledex = check_file("data/robots/intelledex-660.json").summary;
  EXPECT_TRUE(has_line(intelledex, "Jaws: open 0 to 60 mm, 41.042 mm at the soft home"));
  EXPECT_TRUE(has_line(intelledex, "Net roll: + base - tool roll - 90 deg"));
}

TEST(CheckReport, SummaryOfAWorkcell) {
  const std::string text = check_file("data/workcells/adept-one.json").summary;
  const std::string lines[] = {
      "Adept One table: 5 blocks, a camera",
      "Workspace: x 0 to 900, y -800 to 800, z 0 to 1000 mm",
      "Work surface: z = 500 mm; a tool tip under it raises a warning",
      "  blue         70     40      30  620  -150   515      115  bright blue",
      "Camera: at (540, 0, 1500) mm, orthographic, field 480 x 480 mm, 192 x 192 pixels of 2.5 x "
      "2.5 mm",
  };
  for (const std::string& line : lines) EXPECT_TRUE(has_line(text, line)) << line << "\n" << text;
}

TEST(CheckReport, AFileWithOnlyWarningsIsValid) {
  const CheckResult robot = check_file("data/robots/intelledex-660.json");
  const std::string text = test::project_file("data/workcells/rhino-xr3.json");
  const CheckResult alone = check_text(text, "f", Profile::kPaper);
  EXPECT_TRUE(alone.findings.empty());
  std::string wide = text;
  wide.replace(wide.find("[64, 32, 40]"), 12, "[64, 62, 40]");
  const CheckResult checked = check_text(wide, "f", Profile::kPaper, &*robot.robot);
  EXPECT_TRUE(checked.is_good());
  ASSERT_EQ(checked.findings.size(), 1U);
  EXPECT_EQ(checked.findings[0].severity, Severity::kWarning);
  EXPECT_FALSE(checked.summary.empty());
}

TEST(TextTable, AlignsColumns) {
  EXPECT_EQ(text_table({{"a", "b"}, {"long", "1"}, {"x", "-20"}}, "lr"),
            "  a       b\n  long    1\n  x     -20\n");
}

TEST(TextTable, WritesNumbersWithoutTrailingZeros) {
  EXPECT_EQ(plain_number(1.5), "1.5");
  EXPECT_EQ(plain_number(100), "100");
  EXPECT_EQ(plain_number(0.12345, 2), "0.12");
  EXPECT_EQ(plain_number(-0.0001), "0");
}

}  // namespace
}  // namespace xr3
