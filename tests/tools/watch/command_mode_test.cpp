// Command mode as a transcript: keys in; functions to run, the menu and the prompt out.
#include "tools/watch/command_mode.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace xr3::watch {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr char kEscape = '\x1B';

ModeKey letter(char c) { return {c, 0, false}; }
ModeKey alt(int function) { return {0, function, true}; }

/// The functions that a row of letters runs.
std::vector<FunctionCall> run(CommandMode& mode, const std::string& letters) {
  std::vector<FunctionCall> calls;
  for (const char c : letters) {
    if (const auto call = mode.press(letter(c), {}).call) calls.push_back(*call);
  }
  return calls;
}

TEST(CommandMode, EachFunctionHasALetterAndMostAnAltKey) {
  CommandMode mode;
  const std::vector<FunctionCall> plain{
      {"display", {}}, {"home", {}}, {"enabled", {}}, {"function_keys", {}}, {"path", {}}};
  EXPECT_EQ(run(mode, "dhekp"), plain);
  EXPECT_EQ(mode.press(alt(1), {}).call, (FunctionCall{"display", {}}));
  EXPECT_EQ(mode.press(alt(3), {}).call, (FunctionCall{"home", {}}));
  EXPECT_EQ(mode.press(alt(5), {}).call, (FunctionCall{"enabled", {}}));
  EXPECT_EQ(mode.press(alt(6), {}).call, (FunctionCall{"function_keys", {}}));
}

TEST(CommandMode, AsksForAValue) {
  CommandMode mode;
  EXPECT_EQ(run(mode, "s2\n"), (std::vector<FunctionCall>{{"status", {2}}}));
  EXPECT_EQ(run(mode, "v1, -2 3\r"), (std::vector<FunctionCall>{{"view", {1, -2, 3}}}));
  EXPECT_EQ(run(mode, "r255\n"), (std::vector<FunctionCall>{{"period", {255}}}));
  mode.press(alt(4), {});
  EXPECT_THAT(mode.prompt(), HasSubstr("status line (0 to 6): _"));
  run(mode, "57\b");
  EXPECT_THAT(mode.prompt(), HasSubstr("status line (0 to 6): 5_"));
  run(mode, std::string(1, kEscape));
  EXPECT_EQ(mode.prompt(), "");
}

TEST(CommandMode, AsksAgainAfterAWrongValue) {
  CommandMode mode;
  for (const std::string wrong : {"s7\n", "\b9\n", "\b\b\n", "1 2\n", "-1\n"}) {
    EXPECT_TRUE(run(mode, wrong).empty()) << wrong;
    EXPECT_THAT(mode.prompt(), HasSubstr("not this: ")) << wrong;
  }
  run(mode, std::string(1, kEscape));
  for (const std::string wrong : {"v0 0 0\n", "1 2 10\n", "1 2\n", "--\n"}) {
    EXPECT_TRUE(run(mode, wrong).empty()) << wrong;
    run(mode, std::string(1, kEscape) + "v");
  }
}

TEST(CommandMode, TheInputIsBounded) {
  CommandMode mode;
  run(mode, "v" + std::string(1000, '1'));
  EXPECT_LT(mode.prompt().size(), 120U);
}

// The paper: Alt F6 disables the function keys, never itself. The letters are ours and stay.
TEST(CommandMode, FunctionKeysCanBeOff) {
  CommandMode mode;
  Display off;
  off.has_function_keys = false;
  const CommandMode::KeyResult home = mode.press(alt(3), off);
  EXPECT_TRUE(home.is_taken);
  EXPECT_FALSE(home.call);
  EXPECT_TRUE(mode.press(alt(6), off).call);
  EXPECT_TRUE(mode.press(letter('h'), off).call);
}

TEST(CommandMode, TheMenuRunsFunctionsByPlainFunctionKeysToo) {
  CommandMode mode;
  EXPECT_FALSE(mode.press({0, 3, false}, {}).is_taken);
  EXPECT_TRUE(mode.press({'-', 0, true}, {}).is_taken);
  EXPECT_TRUE(mode.is_menu_open());
  EXPECT_EQ(mode.press({0, 3, false}, {}).call, (FunctionCall{"home", {}}));
  EXPECT_TRUE(mode.press(letter(kEscape), {}).is_taken);
  EXPECT_FALSE(mode.is_menu_open());
  run(mode, "mm");
  EXPECT_FALSE(mode.is_menu_open());
}

TEST(CommandMode, LeavesOtherKeysAlone) {
  CommandMode mode;
  for (const char c : {'q', ' ', '?', '.', kEscape, '\0'}) {
    EXPECT_FALSE(mode.press(letter(c), {}).is_taken) << static_cast<int>(c);
  }
  EXPECT_FALSE(mode.press({'h', 0, true}, {}).is_taken);
  EXPECT_FALSE(mode.press(alt(9), {}).is_taken);
}

TEST(CommandMode, TheMenuShowsValues) {
  Display display;
  display.is_on = true;
  display.view = {1, -2, 3};
  display.status_option = 2;
  display.period_ticks = 500;
  const std::vector<std::string> lines = menu_lines(display, false);
  EXPECT_THAT(lines, Contains("  d    Alt F1  graphics display        on"));
  EXPECT_THAT(lines, Contains("  v    Alt F2  view vector             1, -2, 3"));
  EXPECT_THAT(lines, Contains("  s    Alt F4  status line             joint variables"));
  EXPECT_THAT(lines, Contains("  e    Alt F5  simulator               disabled"));
  EXPECT_THAT(lines, Contains("  r            refresh period          0.5 s"));
}

}  // namespace
}  // namespace xr3::watch
