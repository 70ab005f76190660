// Access by tokens. The clock is manual except where a test says otherwise.
#include "server/service/sessions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/monitor_fixture.hpp"

namespace xr3 {
namespace {

AccessPolicy with_token(ReadAccess reading) {
  AccessRules rules;
  rules.token = "sixteen-letters!";
  rules.reading = reading;
  return AccessPolicy(rules);
}

class WithToken : public test::MonitorFixture {
 protected:
  WithToken() : MonitorFixture(with_token(ReadAccess::kFree)) {}
};

TEST_F(WithToken, ReadingIsFreeAndCallsNeedTheToken) {
  EXPECT_EQ(read(one_).at(0)["access"], "read");
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"state"})")["op"], "state");
  EXPECT_EQ(call(one_, "home")["error"]["code"], "token_required");
  const Json granted = answer(one_, R"({"op":"auth","id":1,"token":"sixteen-letters!"})");
  EXPECT_EQ(granted.dump(), R"({"op":"result","id":1,"ok":true,"value":{"access":"control"}})");
  EXPECT_EQ(call(one_, "home")["ok"], true);
}

TEST_F(WithToken, TheTokenIsCheckedBeforeAnythingElse) {
  read(one_);
  for (const std::string& text : std::vector<std::string>{
           R"({"op":"call","id":7,"fn":"step","args":{"ticks":"x","ticks":1}})",
           R"({"op":"call","id":7,"fn":"step","args":nonsense)",
           R"({"op":"call","id":7,"fn":"step")",
           R"({"args":)" + std::string(40, '[') + std::string(40, ']') +
               R"(,"op":"call","id":7,"fn":"step"})",
           R"({"op":"call","id":7,"fn":"step","cell":"other"})",
           R"({"op":"call","id":7,"fn":"fly"})", R"({"\u006fp":"call","id":7})"}) {
    const Json result = answer(one_, text);
    EXPECT_EQ(result["error"]["code"], "token_required") << text;
    EXPECT_EQ(result["id"], 7) << text;
  }
  EXPECT_EQ(answer(one_, R"({"op":"call","fn":"step"})")["error"]["message"],
            "the call step needs the token");
  EXPECT_EQ(answer(one_, R"({"op":"call","fn":"fly"})")["error"]["message"],
            "a call needs the token");
  EXPECT_EQ(answer(one_, R"({"op":"ping")")["error"]["code"], "bad_json");
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"taste"})")["error"]["code"], "unknown_channel");
}

TEST_F(WithToken, FiveWrongTokensEndTheConnection) {
  read(one_);
  const std::string wrong = R"({"op":"auth","id":1,"token":"wrong"})";
  const auto slow_answer = [&] {
    EXPECT_EQ(ask(one_, wrong).size(), 0U) << "wrong tokens are answered late";
    return wait(one_);
  };
  for (int i = 0; i < 4; ++i) {
    const auto answers = slow_answer();
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_EQ(answers[0]["error"]["code"], "bad_token");
  }
  const auto last = slow_answer();
  EXPECT_EQ(service_.counters().wrong_tokens, 5U);
  ASSERT_EQ(last.size(), 2U);
  EXPECT_EQ(last[1]["why"], "bad_token");
  EXPECT_TRUE(one_.client().has_ended());
}

class Private : public test::MonitorFixture {
 protected:
  Private() : MonitorFixture(with_token(ReadAccess::kWithToken)) {}
};

TEST_F(Private, ReadingNeedsTheToken) {
  read(one_);
  for (const char* op : {"get", "sub"}) {
    const std::string request = std::string(R"({"op":")") + op + R"(","channel":"state"})";
    EXPECT_EQ(answer(one_, request)["error"]["code"], "token_required");
  }
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"taste","fields":[)")["error"]["code"],
            "token_required");
  const auto answers = ask(one_, R"({"op":"auth","token":"sixteen-letters!"})");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0]["value"]["access"], "control");
  EXPECT_EQ(answers[1]["op"], "hello");
  EXPECT_EQ(answers[1]["robot"]["name"], "Rhino XR-3");
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"state"})")["op"], "state");
}

}  // namespace
}  // namespace xr3
