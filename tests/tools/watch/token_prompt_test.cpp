#include "tools/watch/token_prompt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace xr3::watch {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The token that these letters send; empty if they send none.
std::string typed(TokenPrompt& prompt, const std::string& letters) {
  std::string token;
  for (const char letter : letters) token += prompt.press({letter, 0, false}).value_or("");
  return token;
}

TEST(TokenPrompt, GivesTheTokenAtEnter) {
  TokenPrompt prompt;
  prompt.open();
  EXPECT_EQ(typed(prompt, "nonsense\x15sixteen lettersX\x7F!\r"), "sixteen letters!");
  EXPECT_FALSE(prompt.is_open());
  prompt.open();
  EXPECT_EQ(typed(prompt, "sch\xC3\xB6n\n"), "sch\xC3\xB6n")
      << "nothing is left of the first token";
}

TEST(TokenPrompt, ShowsTheNumberOfCharactersOnly) {
  TokenPrompt prompt;
  EXPECT_EQ(prompt.text(), "");
  prompt.open();
  typed(prompt, "secret");
  EXPECT_THAT(prompt.text(), HasSubstr("6 characters"));
  EXPECT_THAT(prompt.text(), Not(HasSubstr("secret")));
}

TEST(TokenPrompt, EscapeForgetsTheInput) {
  TokenPrompt prompt;
  prompt.open();
  EXPECT_EQ(typed(prompt, "secret\x1B"), "");
  EXPECT_FALSE(prompt.is_open());
  prompt.open();
  EXPECT_EQ(typed(prompt, "\r"), "");
}

TEST(TokenPrompt, IgnoresFunctionKeysAndAlt) {
  TokenPrompt prompt;
  prompt.open();
  prompt.press({0, 1, true});
  prompt.press({'x', 0, true});
  EXPECT_EQ(typed(prompt, "plain\r"), "plain");
}

}  // namespace
}  // namespace xr3::watch
