// Compares the screens of `xr3 watch` as text with tests/golden (XR3_UPDATE_GOLDEN=1 rewrites
// them), and tests properties for every size.
#include "tools/watch/screen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/models.hpp"
#include "tests/support/watched.hpp"
#include "tools/watch/panels.hpp"

namespace xr3::watch {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Link live() { return {Link::Phase::kLive, "localhost:9601", ""}; }
Link gone() { return {Link::Phase::kTrying, "localhost:9601", "the server is stopping"}; }

std::string text(const Known& known, int rows, int columns, const Link& link = live()) {
  return text_of(watch_screen(known, link, Page::kCell, rows, columns), Letters::kUnicode);
}

Known with_state(const std::string& from, const std::string& to) {
  WatchModel model = test::watched_model();
  model.handle(test::watched_state(from, to));
  return model.known();
}

void expect_golden(const std::string& screen, const std::string& name) {
  const std::string path = "tests/golden/" + name + ".txt";
  if (std::getenv("XR3_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(std::string(XR3_SOURCE_DIR) + "/" + path) << screen;
  }
  EXPECT_EQ(screen, test::project_file(path)) << path;
}

TEST(WatchScreen, MatchesTheGoldens) {
  const Known known = test::watched_model().known();
  expect_golden(text(known, 24, 80), "watch-80x24");
  expect_golden(text(known, 60, 200), "watch-200x60");
  expect_golden(text(known, 12, 44), "watch-44x12");
}

TEST(WatchScreen, ShowsTheTimeAloneIfTheTickDoesNotFit) {
  Known known = test::watched_model().known();
  known.tick = 123'456'789;
  EXPECT_THAT(text(known, 24, 80), HasSubstr("123456.789 s\n"));
  EXPECT_THAT(text(known, 24, 200), HasSubstr("tick 123456789   123456.789 s\n"));
}

TEST(WatchScreen, OtherPagesMatchTheGoldens) {
  const Link refused{Link::Phase::kTrying, "localhost:9601",
                     "cannot connect to localhost:9601 (Connection refused)"};
  expect_golden(text({}, 24, 80, refused), "watch-no-server");
  expect_golden(text_of(watch_screen({}, live(), Page::kHelp, 24, 80), Letters::kUnicode),
                "watch-help");
}

Known with_lines() {
  WatchModel model = test::watched_model();
  model.handle(test::watched_lines());
  return model.known();
}

std::string lines_text(const Known& known, int rows, int columns, const Link& link = live()) {
  return text_of(watch_screen(known, link, Page::kLines, rows, columns), Letters::kUnicode);
}

TEST(WatchScreen, LinesMatchTheGoldens) {
  expect_golden(lines_text(with_lines(), 24, 100), "watch-lines-100x24");
  expect_golden(lines_text(with_lines(), 8, 60), "watch-lines-60x8");
}

TEST(WatchScreen, LinesThatDoNotFitAreCounted) {
  Known known = with_lines();
  known.lines->resize(20, known.lines->at(1));
  EXPECT_THAT(lines_text(known, 10, 100), HasSubstr("\n and 14 more\n"));
  EXPECT_THAT(lines_text(known, 23, 100), Not(HasSubstr("more")));
}

TEST(WatchScreen, LinesSayWhatToDoWithoutAnyAndWithoutTheToken) {
  Known known = with_lines();
  known.lines->clear();
  EXPECT_THAT(lines_text(known, 24, 80), HasSubstr("run xr3 term"));
  EXPECT_THAT(lines_text(known, 24, 80, gone()), HasSubstr("retrying"));
  known.has_control = false;
  EXPECT_THAT(lines_text(known, 24, 80), HasSubstr("Press t and type it"));
}

TEST(WatchScreen, AgesHaveTheTwoLargestUnits) {
  EXPECT_EQ(age_text(-1), "0 s");
  EXPECT_EQ(age_text(59), "59 s");
  EXPECT_EQ(age_text(60), "1 min 0 s");
  EXPECT_EQ(age_text(3599), "59 min 59 s");
  EXPECT_EQ(age_text(2 * 3600 + 5 * 60 + 59), "2 h 5 min");
  EXPECT_EQ(age_text(100 * 86400 + 7199), "100 d 1 h");
}

TEST(WatchScreen, ShowsWhoGetsTheCommandsWhileDisabled) {
  const auto banner = [](const std::string& device) {
    return text(with_state("\"enabled\":true", "\"enabled\":false,\"device\":" + device), 24, 80);
  };
  EXPECT_THAT(banner("null"), HasSubstr("disabled: only A@ is executed"));
  EXPECT_THAT(banner(R"({"path":"/dev/arm","open":true,"engaged":false})"),
              HasSubstr("disabled: only A@ is executed"))
      << "a snapshot has disabled the simulator";
  EXPECT_THAT(banner(R"({"path":"/dev/arm","open":true,"engaged":true})"),
              HasSubstr("disabled: commands go to device /dev/arm"));
  EXPECT_THAT(banner(R"({"path":"/dev/arm","open":false,"engaged":true})"),
              HasSubstr("/dev/arm is not there; commands are dropped"));
}

TEST(WatchScreen, DrawsEverySize) {
  Known known = with_lines();
  for (int rows = 1; rows < 40; ++rows) {
    for (int columns = 1; columns < 210; columns += 7) {
      const TextScreen screen = watch_screen(known, live(), Page::kCell, rows, columns);
      ASSERT_EQ(screen.rows(), rows);
      ASSERT_EQ(screen.columns(), columns);
      watch_screen(known, gone(), Page::kCell, rows, columns);
      watch_screen(known, live(), Page::kHelp, rows, columns);
      watch_screen(known, live(), Page::kLines, rows, columns);
      watch_screen({}, gone(), Page::kCell, rows, columns);
    }
  }
}

// Each row: the minimum height at which a part is visible, in order of importance.
TEST(WatchScreen, SmallScreensDropTheLeastImportantPartsFirst) {
  const Known known = test::watched_model().known();
  const auto least_rows = [&known](const std::string& what) {
    int rows = 1;
    while (text(known, rows, 100).find(what) == std::string::npos && rows < 99) ++rows;
    return rows;
  };
  const int joint = least_rows("-50.00 deg");
  const int tool = least_rows("holds red");
  const int warning = least_rows("B+200");
  const int block = least_rows("green");
  const int camera = least_rows("camera");
  EXPECT_LT(joint, tool);
  EXPECT_LT(tool, warning);
  EXPECT_LT(warning, block);
  EXPECT_LE(block, camera);
  EXPECT_LT(camera, 24);
}

TEST(WatchScreen, NarrowTablesDropTheValueLast) {
  const Known known = test::watched_model().known();
  const auto least_columns = [&known](const std::string& what) {
    int columns = 1;
    while (text(known, 24, columns).find(what) == std::string::npos && columns < 300) ++columns;
    return columns;
  };
  EXPECT_LT(least_columns("-50.00 deg"), least_columns("count"));
  EXPECT_LT(least_columns(" count"), least_columns(" error"));
  EXPECT_LT(least_columns(" error"), least_columns(" switch"));
  EXPECT_LT(least_columns(" switch"), least_columns(" speed"));
  EXPECT_LT(least_columns(" speed"), least_columns(" from"));
  EXPECT_LE(least_columns(" from"), 80);
}

TEST(WatchScreen, TheBarFollowsTheValue) {
  const auto bar = [](const std::string& value) {
    std::string row = text(with_state("\"value\":-50.0", "\"value\":" + value), 24, 50);
    row = row.substr(row.find(" C "));
    return row.substr(3, row.find(' ', 3) - 3);
  };
  EXPECT_EQ(bar("-100.0").find("█"), std::string::npos);
  EXPECT_EQ(bar("100.0").find("·"), std::string::npos);
  EXPECT_EQ(bar("0.0"), "██████······");
  EXPECT_EQ(bar("-10.0"), "█████▍······");
  EXPECT_EQ(bar("1e300"), bar("100.0")) << "values beyond a limit are drawn at the limit";
  EXPECT_EQ(bar("-1e300"), bar("-100.0"));
}

TEST(WatchScreen, ABlockedJointIsRed) {
  const TextScreen screen =
      watch_screen(test::watched_model().known(), live(), Page::kCell, 24, 80);
  EXPECT_EQ(screen.at(2, 1).letter, U'C');
  EXPECT_EQ(screen.at(2, 1).style, TextStyle::kGood);
  EXPECT_EQ(screen.at(3, 1).letter, U'B');
  EXPECT_EQ(screen.at(3, 1).style, TextStyle::kBad);
  EXPECT_EQ(screen.at(4, 1).style, TextStyle::kPlain);
}

TEST(WatchScreen, ShowsStalledAndDisabled) {
  EXPECT_THAT(text(with_state("\"stalled\":null", "\"stalled\":\"protected_region\""), 24, 80),
              HasSubstr("STALLED: the tool would enter the protected region"));
  EXPECT_THAT(text(with_state("\"stalled\":null", "\"stalled\":\"work_surface\""), 24, 80),
              HasSubstr("STALLED: the tool would enter the work surface"));
  EXPECT_THAT(text(with_state("\"enabled\":true", "\"enabled\":false"), 24, 80),
              HasSubstr("disabled"));
}

TEST(WatchScreen, AfterADisconnectTheLastStateStays) {
  const std::string screen = text(test::watched_model().known(), 24, 80, gone());
  EXPECT_THAT(screen, HasSubstr("the server is stopping; retrying, the last known state is below"));
  EXPECT_THAT(screen, HasSubstr("-50.00 deg"));
}

TEST(WatchScreen, HidesKeysWithoutAnEffect) {
  WatchModel model({});
  model.handle(test::watched_hello("read"));
  model.handle(test::watched_state());
  EXPECT_THAT(text(model.known(), 24, 80), HasSubstr("read only"));
  EXPECT_THAT(text(model.known(), 24, 80), Not(HasSubstr("h home")));
  const Known manual = with_state("\"real\"", "\"manual\"");
  EXPECT_THAT(text(manual, 24, 80), HasSubstr("space resume   . step   h home"));
  EXPECT_THAT(text(manual, 24, 80), HasSubstr("paused   epoch"));
}

TEST(WatchScreen, CountsBlocksThatDoNotFit) {
  Known known = test::watched_model().known();
  known.state->blocks.resize(100, {"twin", {}, 0, false});
  EXPECT_THAT(text(known, 24, 80), HasSubstr("and 9"));
  EXPECT_THAT(text(known, 24, 80), HasSubstr("inputs 1"));
}

TEST(WatchScreen, TruncatesLongNamesOfBlocks) {
  const Known known =
      with_state("\"name\":\"green\"", R"("name":"\u001b[2Jvery long \u202e name")");
  EXPECT_THAT(text(known, 24, 80), HasSubstr("?[2Jvery… "));
}

TEST(WatchScreen, ShrinksAnImageUntilItFits) {
  WatchedImage image{6, 4, std::vector<bool>(24, false)};
  image.pixels[0] = image.pixels[1] = true;  // two of the four left upper pixels
  const WatchedImage small = shrunk(image, 3, 99);
  EXPECT_EQ(small.width, 3U);
  EXPECT_EQ(small.height, 2U);
  EXPECT_THAT(small.pixels, ElementsAre(true, false, false, false, false, false));
  EXPECT_EQ(shrunk(image, 99, 2).width, 3U) << "limited by its height";
  EXPECT_EQ(shrunk(image, 99, 99).pixels, image.pixels) << "never larger";
  EXPECT_EQ(shrunk(image, 1, 1).pixels.size(), 1U);
  EXPECT_EQ(shrunk({4096, 1, std::vector<bool>(4096, true)}, 5, 5).pixels.size(), 5U);
}

TEST(WatchScreen, ACharacterHoldsTwoPixels) {
  Known known = test::watched_model().known();
  known.image = WatchedImage{4, 2, {true, true, false, false, true, false, true, false}};
  EXPECT_THAT(text(known, 30, 80), HasSubstr("█▀▄"));
}

}  // namespace
}  // namespace xr3::watch
