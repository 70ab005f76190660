// The members of `display` messages.
#include "protocol/monitor/display.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/models.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

Rig rhino_at_its_table() {
  return Rig(std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                           test::workcell_named("rhino-xr3"), Profile::kPaper));
}

Json shown(const Rig& rig) { return display_json(rig.model(), rig.state()); }

TEST(DisplayJson, ShowsTheInitialSettings) {
  const Json display = shown(rhino_at_its_table());
  std::vector<std::string> names;
  for (const auto& [name, value] : display.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"on", "view", "erase", "period_ticks", "function_keys",
                                             "extents_mm", "polylines", "status"}));
  EXPECT_EQ(display["on"], false);
  EXPECT_EQ(display["view"].dump(), "[1,1,1]");
  EXPECT_EQ(display["erase"], true);
  EXPECT_EQ(display["period_ticks"], 3000);
  EXPECT_EQ(display["function_keys"], true);
  EXPECT_EQ(display["status"].dump(), R"({"option":0,"text":""})");
}

TEST(DisplayJson, ShowsEverySetting) {
  Rig rig = rhino_at_its_table();
  rig.execute(ToggleDisplay{});
  rig.execute(SetViewVector{0, -1, 0});
  rig.execute(SetRefreshPeriod{3});
  rig.execute(ToggleErasing{});
  rig.execute(ToggleFunctionKeys{});
  rig.execute(SelectStatus{3});
  rig.move('E', 5);
  const Json display = shown(rig);
  EXPECT_EQ(display["on"], true);
  EXPECT_EQ(display["view"].dump(), "[0,-1,0]");
  EXPECT_EQ(display["erase"], false);
  EXPECT_EQ(display["period_ticks"], 1500);
  EXPECT_EQ(display["function_keys"], false);
  EXPECT_EQ(display["status"].dump(), R"({"option":3,"text":"F 0  E 5  D 0  C 0  B 0  A 0"})");
}

// In a view along +y, x is to the right and z up, so the numbers are the workspace's.
TEST(DisplayJson, ExtentsAreLeftBottomRightTop) {
  Rig rig = rhino_at_its_table();
  rig.execute(SetViewVector{0, -1, 0});
  const Workspace& room = rig.model().workcell().workspace;
  const Json extents = shown(rig)["extents_mm"];
  ASSERT_EQ(extents.size(), 4U);
  EXPECT_LE(extents[0], 0.0);
  EXPECT_EQ(extents[1], 0.0);
  EXPECT_EQ(extents[2], mm(room.x_um));
  EXPECT_EQ(extents[3], mm(room.z_um));
}

TEST(DisplayJson, ShowsRobotBlocksAndPath) {
  Rig rig = rhino_at_its_table();
  rig.execute(SetViewVector{0, 0, 1});
  rig.execute(ToggleErasing{});
  rig.move('F', 50);
  rig.settle();
  std::set<std::string> parts;
  const Json display = shown(rig);
  for (const Json& line : display["polylines"]) {
    parts.insert(line["part"].get<std::string>());
    EXPECT_EQ(line["color"].get<std::string>().size(), 7U);
    EXPECT_GE(line["points"].size(), 2U);
    for (const Json& point : line["points"]) EXPECT_EQ(point.size(), 2U);
  }
  for (const char* part : {"base", "link1", "tool", "finger+1", "block:red", "path"}) {
    EXPECT_EQ(parts.count(part), 1U) << part;
  }
  // Seen from above, the path begins at the tip's position at the soft home.
  const Json& path = display["polylines"].back();
  EXPECT_EQ(path["part"], "path");
  EXPECT_EQ(path["points"][0].dump(), "[238.1,0.0]");
}

TEST(DisplayJson, NumbersHaveAtMostThreeDecimals) {
  Rig rig = rhino_at_its_table();
  rig.move('E', 77);
  rig.settle();
  const Json display = shown(rig);
  for (const Json& line : display["polylines"]) {
    for (const Json& point : line["points"]) {
      for (const Json& value : point) {
        const std::string text = value.dump();
        EXPECT_LE(text.size() - text.find('.') - 1, 3U) << text;
      }
    }
  }
}

}  // namespace
}  // namespace xr3
