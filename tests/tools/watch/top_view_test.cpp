// The workspace from above in characters.
#include "tools/watch/top_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

Workcell small_cell() {
  Workcell cell;
  cell.name = "small";
  cell.workspace = {80'000, 100'000, 100'000};
  return cell;
}

Block block(const std::string& name, PointUm size, PointUm centroid, int yaw_deg) {
  return {name, size, centroid, yaw_deg * Microdegrees{1'000'000}, 9};
}

TEST(TopView, XPointsToTheRightAndYUpAsInTheCamerasPicture) {
  Workcell cell = small_cell();
  cell.blocks = {block("left", {12'000, 30'000, 10'000}, {70'000, 60'000, 5'000}, 0),
                 block("front", {12'000, 30'000, 10'000}, {40'000, 0, 5'000}, 90)};
  EXPECT_EQ(top_view(cell, {}),
            " y = 100 mm\n"
            "+--------------------+\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                lll |\n"
            "|                lll |\n"
            "|                lll |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "R      ffffffff      |\n"
            "|      ffffffff      |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "|                    |\n"
            "+--------------------+\n"
            " y = -100      x = 80\n"
            " R robot   a character is 4 x 8 mm\n"
            " l left, f front\n");
}

TEST(TopView, TheUpperOfTwoBlocksIsVisible) {
  Workcell cell = small_cell();
  cell.blocks = {block("upper", {10'000, 10'000, 10'000}, {40'000, 0, 15'000}, 0),
                 block("lower", {30'000, 30'000, 10'000}, {40'000, 0, 5'000}, 0)};
  const std::string view = top_view(cell, {});
  EXPECT_NE(view.find("llluulll"), std::string::npos) << view;
}

TEST(TopView, ReachIsDottedAndTheCamerasEdgeIsDrawn) {
  Workcell cell = small_cell();
  cell.camera = Camera{{40'000, 0, 90'000}, 30'000, 60'000, 10, 10, Projection::kOrthographic};
  const std::string view =
      top_view(cell, [](double x_mm, double y_mm) { return x_mm < 10 && y_mm > 0; });
  EXPECT_NE(view.find("|..    ::::::::      |\n"
                      "|..    :      :      |\n"),
            std::string::npos)
      << view;
  EXPECT_NE(view.find("R..    :      :      |\n"
                      "|      :      :      |\n"),
            std::string::npos)
      << view;
}

TEST(TopView, OmitsEverythingOutsideTheWorkspace) {
  Workcell cell = small_cell();
  cell.blocks = {block("far", {10'000, 10'000, 10'000}, {90'000'000, -90'000'000, 0}, 45),
                 block("behind", {10'000, 10'000, 10'000}, {-20'000, 0, 0}, 0),
                 block("vast", {100'000'000, 100'000'000, 10'000}, {0, 0, 0}, 0)};
  cell.camera = Camera{{0, 0, 1'000'000}, 90'000'000, 90'000'000, 1, 1, Projection::kOrthographic};
  const std::string view = top_view(cell, {});
  EXPECT_EQ(view.find_first_of(":"), view.find(": camera's")) << view;
  EXPECT_EQ(std::count(view.begin(), view.end(), 'b'), 3)
      << "its name and letter, and robot: " << view;
}

TEST(TopView, FitsATerminal) {
  for (const Workspace space : {Workspace{1, 100'000'000, 1}, Workspace{100'000'000, 1, 1},
                                Workspace{1, 1, 1}, Workspace{123'456, 654'321, 1}}) {
    Workcell cell = test::workcell_named("rhino-hundred");
    cell.workspace = space;
    const std::string view = top_view(cell, {});
    EXPECT_LE(std::count(view.begin(), view.end(), '\n'), 46);
    for (std::size_t begin = 0; begin < view.size(); begin = view.find('\n', begin) + 1) {
      EXPECT_LE(view.find('\n', begin) - begin, 80U) << view;
    }
  }
}

std::vector<Block> named(const std::vector<std::string>& names) {
  std::vector<Block> blocks;
  for (const std::string& name : names) blocks.push_back(block(name, {1, 1, 1}, {}, 0));
  return blocks;
}

TEST(TopView, ABlockHasALetterOfItsName) {
  EXPECT_EQ(block_letters(named({"red", "green", "blue", "magenta", "yellow"})), "rgbmy");
  EXPECT_EQ(block_letters(named({"blue", "brown", "red"})), "bnr") << "initials go first";
  EXPECT_EQ(block_letters(named({"Red", "1", "\xC3\xA9", "r", ""})), "r1abc");
  EXPECT_EQ(block_letters(named({"block 1", "block 2", "block 3"})), "b23");
}

TEST(TopView, LettersAreUniqueUntilTheyRunOut) {
  const std::string all = block_letters(named(std::vector<std::string>(70, "block")));
  const std::string given = all.substr(0, 61);
  EXPECT_EQ((std::set<char>{given.begin(), given.end()}.size()), 61U);
  EXPECT_EQ(given.find('R'), std::string::npos);
  EXPECT_EQ(all.substr(61), "#########");
}

}  // namespace
}  // namespace xr3
