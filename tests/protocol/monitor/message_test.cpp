// The exact text of the server's messages.
#include "protocol/monitor/message.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/home.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/request_error.hpp"
#include "tests/support/models.hpp"

namespace xr3::monitor {
namespace {

TEST(MonitorMessage, Hello) {
  const ModelPtr model = test::rhino();
  EXPECT_EQ(
      *hello({"xr3 0.1.0", {"main"}, GreetedCell{"main", *model, {}}}),
      R"({"op":"hello","proto":1,"server":"xr3 0.1.0","cell":"main","cells":["main"],"epoch":0,)"
      R"("tick":0,)"
      R"("tick_hz":1000,"clock":{"mode":"real","rate":1.0},"compat":"paper",)"
      R"("robot":{"name":"Rhino XR-3","joints":["F","E","D","C","B"],"tool":"A"},)"
      R"("access":"control",)"
      R"("channels":["state","image","event","line","display","model","overview"],)"
      R"("calls":)" +
          Json(calls()).dump() + "," +
          R"("limits":{"message_bytes":262144,"depth":32,"max_hz":60}})");
}

TEST(MonitorMessage, HelloNamesCellsAndProfile) {
  const ModelPtr model = test::rhino(Profile::kMark3);
  const CellTime now{.epoch = 4, .tick = 77, .mode = ClockMode::kManual, .rate = {}};
  const Json json = Json::parse(*hello({"xr3", {"a", "b"}, GreetedCell{"a", *model, now}}));
  EXPECT_EQ(json["cell"], "a");
  EXPECT_EQ(json["cells"].dump(), R"(["a","b"])");
  EXPECT_EQ(json["compat"], "mark3");
  EXPECT_EQ(json["epoch"], 4);
  EXPECT_EQ(json["tick"], 77);
  EXPECT_EQ(json["clock"]["mode"], "manual");
}

TEST(MonitorMessage, HelloWithoutAccessDescribesTheServerOnly) {
  const ModelPtr model = test::rhino();
  const Json json =
      Json::parse(*hello({"xr3", {"main"}, GreetedCell{"main", *model, {}}, Access::kNone}));
  EXPECT_EQ(json["access"], "none");
  EXPECT_TRUE(json.contains("limits"));
  for (const char* member : {"cell", "cells", "epoch", "tick", "clock", "compat", "robot"})
    EXPECT_FALSE(json.contains(member)) << member;
}

TEST(MonitorMessage, Results) {
  EXPECT_EQ(*result(std::int64_t{7}, {{"epoch", 0}, {"tick", 1434}}),
            R"({"op":"result","id":7,"ok":true,"value":{"epoch":0,"tick":1434}})");
  EXPECT_EQ(*result({}, Json::object()), R"({"op":"result","id":null,"ok":true,"value":{}})");
  EXPECT_EQ(*result({std::int64_t{11},
                     "clock_running",
                     "step needs the manual clock; the clock is real",
                     "call pause first, or start with --clock manual",
                     {}}),
            R"({"op":"result","id":11,"ok":false,"error":{"code":"clock_running",)"
            R"("message":"step needs the manual clock; the clock is real",)"
            R"("hint":"call pause first, or start with --clock manual","details":[]}})");
}

TEST(MonitorMessage, Details) {
  const RequestError error{
      std::string("x"),
      "bad_args",
      "2 wrong fields",
      "nothing was changed",
      {{"/args/ticks", -5, "a number above 0"}, {"/args/after", nullptr, "an object"}}};
  EXPECT_EQ(
      *result(error),
      R"({"op":"result","id":"x","ok":false,"error":{"code":"bad_args","message":"2 wrong fields",)"
      R"("hint":"nothing was changed","details":[{"pointer":"/args/ticks","found":-5,)"
      R"("allowed":"a number above 0"},)"
      R"({"pointer":"/args/after","found":null,"allowed":"an object"}]}})");
}

TEST(MonitorMessage, Pong) {
  EXPECT_EQ(*pong(std::int64_t{16}), R"({"op":"pong","id":16})");
  EXPECT_EQ(*pong(std::string("a\"b")), R"({"op":"pong","id":"a\"b"})");
  EXPECT_EQ(*pong({}), R"({"op":"pong","id":null})");
}

TEST(MonitorMessage, StateWithAndWithoutId) {
  const Json members = {{"stalled", nullptr}, {"moving", false}};
  EXPECT_EQ(*with_id(channel_message(Channel::kState, {"main", 0, 90, 1200}, text_of(members)),
                     std::int64_t{5}),
            R"({"op":"state","id":5,"cell":"main","epoch":0,"seq":90,"tick":1200,"stalled":null,)"
            R"("moving":false})");
  EXPECT_EQ(*channel_message(Channel::kState, {"main", 1, 91, 0}, "{}"),
            R"({"op":"state","cell":"main","epoch":1,"seq":91,"tick":0})");
}

TEST(MonitorMessage, AFrameOfThePast) {
  const Message frame = channel_message(Channel::kState, {"main", 1, 91, 0}, "{}");
  EXPECT_EQ(*as_past(frame, std::int64_t{5}),
            R"({"op":"state","id":5,"past":true,"cell":"main","epoch":1,"seq":91,"tick":0})");
  EXPECT_EQ(*as_past(frame, {}),
            R"({"op":"state","past":true,"cell":"main","epoch":1,"seq":91,"tick":0})");
}

TEST(MonitorMessage, CloseReason) {
  EXPECT_EQ(*bye(CloseReason::kShutdown),
            R"({"op":"bye","why":"shutdown","message":"the server is stopping"})");
  EXPECT_EQ(Json::parse(*bye(CloseReason::kNotJson))["why"], "not_json");
  EXPECT_EQ(Json::parse(*bye(CloseReason::kTooLong))["why"], "too_long");
  EXPECT_EQ(Json::parse(*bye(CloseReason::kFull))["why"], "full");
}

TEST(MonitorMessage, ReplacesInvalidUtf8) {
  EXPECT_NO_THROW((void)Json::parse(*pong(std::string("\xff\xc3"))));
  EXPECT_EQ(result({{}, "c", "two\nlines", "", {}})->find('\n'), std::string::npos);
}

}  // namespace
}  // namespace xr3::monitor
