#include "tools/watch/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/watched.hpp"
#include "tools/watch/read.hpp"

namespace xr3::watch {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

TEST(WatchModel, TheFirstByteStartsAPing) {
  WatchModel model({});
  EXPECT_EQ(model.opening(), "{");
  EXPECT_EQ(model.opening() + model.handle(test::watched_hello()).front(), "{\"op\":\"ping\"}\n");
}

TEST(WatchModel, SubscribesToTheChannelsOfTheServer) {
  WatchModel model({});
  EXPECT_EQ(joined(model.handle(test::watched_hello())),
            "\"op\":\"ping\"}\n"
            "{\"op\":\"sub\",\"channel\":\"model\",\"fields\":[\"robot\"]}\n"
            "{\"op\":\"sub\",\"channel\":\"state\",\"max_hz\":20}\n"
            R"({"op":"sub","channel":"display","fields":["on","view","erase","period_ticks",)"
            "\"function_keys\",\"status\"],\"max_hz\":20}\n"
            "{\"op\":\"sub\",\"channel\":\"image\",\"encoding\":\"rle\",\"max_hz\":10}\n"
            "{\"op\":\"sub\",\"channel\":\"event\"}\n"
            "{\"op\":\"get\",\"channel\":\"event\"}\n"
            "{\"op\":\"ping\",\"id\":\"last\"}\n");
  model.opening();  // of another connection
  EXPECT_THAT(model.handle(R"({"op":"hello","channels":["state"]})"),
              ElementsAre(HasSubstr("ping"), HasSubstr("\"state\""), HasSubstr("\"last\"")));
}

TEST(WatchModel, APrivateServerSendsASecondHelloAfterTheToken) {
  WatchModel model({"", "sixteen letters!", Interest::kOn});
  EXPECT_THAT(model.handle(R"({"op":"hello","access":"none"})"),
              ElementsAre(HasSubstr("ping"), HasSubstr("\"auth\"")));
  EXPECT_THAT(model.handle(R"({"op":"hello","access":"control","channels":["state"]})"),
              ElementsAre(HasSubstr("\"state\""), HasSubstr("\"last\"")));
}

TEST(WatchModel, OnceGetsEveryChannelAndDetectsTheEnd) {
  WatchModel model({"", "", Interest::kOnce});
  const std::string requests = joined(model.handle(test::watched_hello()));
  EXPECT_THAT(requests, Not(HasSubstr("\"sub\"")));
  EXPECT_THAT(requests, HasSubstr("{\"op\":\"get\",\"channel\":\"state\"}\n"));
  model.handle(R"({"op":"pong","id":null})");
  EXPECT_FALSE(model.is_complete()) << "the answer to the opening";
  model.handle(R"({"op":"pong","id":"last"})");
  EXPECT_TRUE(model.is_complete());
}

TEST(WatchModel, SendsTheTokenFirstAndTheCellInEveryRequest) {
  WatchModel model({"second", "sixteen letters!", Interest::kOn});
  const auto requests = model.handle(test::watched_hello("read"));
  EXPECT_EQ(
      requests.at(1),
      "{\"op\":\"auth\",\"id\":\"auth\",\"token\":\"sixteen letters!\",\"cell\":\"second\"}\n");
  for (std::size_t i = 1; i + 1 < requests.size(); ++i) {
    EXPECT_THAT(requests[i], HasSubstr("\"second\""));
  }
  EXPECT_EQ(requests.back(), "{\"op\":\"ping\",\"id\":\"last\"}\n");
  EXPECT_FALSE(model.known().has_control);
  model.handle(R"({"op":"result","id":"auth","ok":true,"value":{"access":"control"}})");
  EXPECT_TRUE(model.known().has_control);
}

TEST(WatchModel, ReadsTheState) {
  const Known known = test::watched_model().known();
  EXPECT_EQ(known.robot, "Teaching arm");
  EXPECT_EQ(known.epoch, 2);
  EXPECT_EQ(known.tick, 12345);
  EXPECT_EQ(known.mode, WatchedClockMode::kReal);
  ASSERT_EQ(known.state->joints.size(), 2U);
  const Axis& second = known.state->joints[1];
  EXPECT_EQ(second.label, "B");
  EXPECT_EQ(second.count, 33);
  EXPECT_EQ(second.unit, "mm");
  EXPECT_TRUE(second.is_closed);
  EXPECT_EQ(second.blocked, "limit");
  EXPECT_EQ(known.state->joints[0].blocked, "");
  EXPECT_TRUE(known.state->joints[0].is_moving);
  EXPECT_EQ(known.state->tool.holding, "red");
  EXPECT_EQ(known.state->tool.xyz_mm[1], -7.5);
  EXPECT_TRUE(known.state->blocks[0].is_held);
  EXPECT_THAT(known.state->aux, ElementsAre(false, true));
  EXPECT_EQ(known.limits.at("B").max, 400);
  EXPECT_EQ(known.limits.at("A").max, 60);
}

TEST(WatchModel, KeepsEventsThatTheTableDoesNotShow) {
  const Known known = test::watched_model().known();
  ASSERT_EQ(known.notes.size(), 2U);
  EXPECT_EQ(known.notes.at(40).message, "soft home by A$");
  EXPECT_EQ(known.notes.at(40).times, 1);
  EXPECT_EQ(known.notes.at(42).times, 3);
  EXPECT_EQ(known.notes.at(42).line, 4);
}

TEST(WatchModel, IgnoresRepeatedEventsAndDropsTheOldest) {
  WatchModel model = test::watched_model();
  for (std::size_t seq = 40; seq < 45 + kMaxNotes; ++seq) {
    model.handle(R"({"op":"event","cell":"main","event":"stalled","message":"s","seq":)" +
                 std::to_string(seq) + "}");
  }
  EXPECT_EQ(model.known().notes.size(), kMaxNotes);
  EXPECT_EQ(model.known().notes.begin()->first, 45);
}

TEST(WatchModel, IgnoresOtherCells) {
  WatchModel model = test::watched_model();
  model.handle(R"({"op":"state","cell":"second","tick":99})");
  EXPECT_EQ(model.known().tick, 12345);
}

TEST(WatchModel, ANewHelloClearsTheState) {
  WatchModel model = test::watched_model();
  model.handle(test::watched_hello());
  EXPECT_FALSE(model.known().state);
  EXPECT_TRUE(model.known().notes.empty());
}

TEST(WatchModel, ReadsImagesOfBothEncodings) {
  const Json runs =
      Json::parse(R"({"width":3,"height":2,"encoding":"rle","rows":[[1,2],[0,1,2]]})");
  const Json text = Json::parse(R"({"width":3,"height":2,"encoding":"rows","rows":["011","100"]})");
  EXPECT_THAT(read_image(runs)->pixels, ElementsAre(false, true, true, true, false, false));
  EXPECT_EQ(read_image(text)->pixels, read_image(runs)->pixels);
}

TEST(WatchModel, RejectsInconsistentImages) {
  for (const char* image : {
           R"({"width":3,"height":1,"encoding":"rle","rows":[[1,1]]})",
           R"({"width":3,"height":1,"encoding":"rle","rows":[[1,3]]})",
           R"({"width":3,"height":1,"encoding":"rle","rows":[[-1,4]]})",
           R"({"width":3,"height":1,"encoding":"rle","rows":[["3"]]})",
           R"({"width":3,"height":2,"encoding":"rle","rows":[[3]]})",
           R"({"width":3,"height":1,"encoding":"rows","rows":["01"]})",
           R"({"width":0,"height":0,"encoding":"rows","rows":[]})",
           R"({"width":3,"height":100000,"encoding":"rle","rows":[]})",
           R"({"width":-1,"height":1,"encoding":"rle","rows":[[]]})",
           R"({"width":3,"height":1,"encoding":"rle","rows":"000"})",
       }) {
    EXPECT_FALSE(read_image(Json::parse(image))) << image;
  }
}

TEST(WatchModel, KeysBecomeCalls) {
  WatchModel model = test::watched_model();
  EXPECT_THAT(*model.ask(Action::kPauseOrResume), HasSubstr("\"pause\""));
  EXPECT_THAT(*model.ask(FunctionCall{"home", {}}), HasSubstr(R"("args":{"function":"home"})"));
  EXPECT_THAT(*model.ask(FunctionCall{"status", {2}}), HasSubstr(R"("value":2})"));
  EXPECT_THAT(*model.ask(FunctionCall{"view", {1, -2, 3}}), HasSubstr(R"("value":[1,-2,3]})"));
  EXPECT_THAT(*model.ask(Action::kStep), HasSubstr("\"ticks\":10"));
  EXPECT_THAT(*model.ask(Action::kStepSecond), HasSubstr("\"ticks\":1000"));
  model.handle(test::watched_state("\"real\"", "\"manual\""));
  EXPECT_THAT(*model.ask(Action::kPauseOrResume), HasSubstr("\"resume\""));
}

TEST(WatchModel, AStepUpdatesTheTickWithoutAStateMessage) {
  WatchModel model = test::watched_model();
  model.handle(
      R"({"op":"result","id":"key","ok":true,"value":{"epoch":3,"tick":12355,"state":{}}})");
  EXPECT_EQ(model.known().epoch, 3);
  EXPECT_EQ(model.known().tick, 12355);
}

TEST(WatchModel, TheTimeIsAskedForAloneAndKeepsTheState) {
  EXPECT_FALSE(WatchModel({}).ask_time()) << "before the first state";
  WatchModel model = test::watched_model();
  const auto joints = model.known().state->joints.size();
  EXPECT_EQ(*model.ask_time(), R"({"op":"get","id":"time","channel":"state","fields":["clock"]})"
                               "\n");
  model.handle(R"({"op":"state","id":"time","cell":"main","epoch":3,"seq":9,"tick":99999,)"
               R"("clock":{"mode":"manual","rate":1.0}})");
  EXPECT_EQ(model.known().tick, 99999);
  EXPECT_EQ(model.known().mode, WatchedClockMode::kManual);
  EXPECT_EQ(model.known().state->joints.size(), joints);
}

TEST(WatchModel, KeysWithoutTheTokenNameTheOption) {
  WatchModel model({});
  model.handle(test::watched_hello("read"));
  EXPECT_FALSE(model.ask(FunctionCall{"home", {}}));
  EXPECT_THAT(model.known().last_message, HasSubstr("--token-file"));
  EXPECT_FALSE(model.ask_lines());
}

constexpr const char* kWrongToken =
    R"({"op":"result","id":"auth","ok":false,"error":{"code":"bad_token","message":"no"}})";

TEST(WatchModel, ATypedTokenIsKeptUntilItIsRefused) {
  WatchModel model({});
  model.handle(test::watched_hello("read"));
  EXPECT_THAT(model.unlock("sixteen letters!"), HasSubstr(R"("token":"sixteen letters!")"));
  model.opening();
  EXPECT_THAT(joined(model.handle(test::watched_hello("read"))), HasSubstr("sixteen letters!"));
  model.handle(kWrongToken);
  EXPECT_THAT(model.known().last_message, HasSubstr("refuses this token: press t"));
  model.opening();
  EXPECT_THAT(joined(model.handle(test::watched_hello("read"))), Not(HasSubstr("auth")));
}

TEST(WatchModel, APrivateServerIsNotAskedWithoutTheToken) {
  constexpr const char* kHello = R"({"op":"hello","access":"none","channels":["state"]})";
  WatchModel model({"", "", Interest::kOnce});
  EXPECT_THAT(model.handle(kHello), ElementsAre(HasSubstr("ping"), HasSubstr("\"last\"")));
  EXPECT_THAT(model.known().last_message, HasSubstr("see --token-file and XR3_TOKEN"));
  WatchModel wrong({"", "sixteen letters!", Interest::kOnce});
  wrong.handle(kHello);
  EXPECT_FALSE(wrong.is_complete());
  wrong.handle(kWrongToken);
  EXPECT_TRUE(wrong.is_complete());
}

TEST(WatchModel, ReadsTheByteClockAndLinesThatWait) {
  WatchModel model = test::watched_model();
  model.handle(test::watched_state("\"mode\":\"real\"", "\"mode\":\"bytes\""));
  EXPECT_EQ(model.known().mode, WatchedClockMode::kBytes);
  EXPECT_THAT(*model.ask(Action::kPauseOrResume), HasSubstr(R"("fn":"pause")"));
  EXPECT_TRUE(model.ask_lines());
  std::string lines = test::watched_lines();
  lines.replace(lines.find(R"("last":"E?")"), 11, R"("last":"","waits_for":2)");
  model.handle(lines);
  EXPECT_EQ(model.known().lines->at(1).last, "waits for line 2");
}

TEST(WatchModel, ReadsTheLinesAndTheDevice) {
  WatchModel model = test::watched_model();
  EXPECT_THAT(*model.ask_lines(), HasSubstr(R"("fn":"lines")"));
  EXPECT_FALSE(model.ask_lines()) << "one request at a time";
  model.handle(test::watched_lines());
  ASSERT_EQ(model.known().lines->size(), 3U);
  const LineEntry& device = model.known().lines->at(0);
  EXPECT_EQ(device.number, std::nullopt);
  EXPECT_EQ(device.kind, "device");
  EXPECT_EQ(device.opened, std::nullopt);
  const LineEntry& line = model.known().lines->at(1);
  EXPECT_EQ(line.number, 3);
  EXPECT_EQ(line.peer, "127.0.0.1:51022");
  EXPECT_EQ(line.opened, 2345);
  EXPECT_EQ(line.bytes_in, 12);
  EXPECT_EQ(line.bytes_out, 1);
  EXPECT_EQ(line.settings, "");
  EXPECT_EQ(line.last, "E?");
  EXPECT_EQ(model.known().lines->at(2).settings, "9600-7e2");
  EXPECT_TRUE(model.ask_lines());
  model.opening();
  EXPECT_TRUE(model.ask_lines()) << "an answer will not come any more";
}

TEST(WatchModel, OnceAsksForTheLinesIfTheyAreWanted) {
  WatchModel model({"", "", Interest::kOnce, true});
  const auto requests = model.handle(test::watched_hello());
  EXPECT_THAT(requests.at(requests.size() - 2), HasSubstr(R"("fn":"lines")"));
}

TEST(WatchModel, ReadsTheDevice) {
  WatchModel model = test::watched_model();
  EXPECT_FALSE(model.known().state->device);
  model.handle(test::watched_state("\"enabled\":true",
                                   R"("enabled":false,"device":{"path":"/dev/arm","open":true})"));
  EXPECT_EQ(model.known().state->device->path, "/dev/arm");
  EXPECT_TRUE(model.known().state->device->is_there);
}

TEST(WatchModel, ShowsAnErrorUntilTheNextKey) {
  WatchModel model = test::watched_model();
  model.handle(R"({"op":"result","id":"key","ok":false,"error":{"code":"clock_running",)"
               R"("message":"step needs the manual clock","hint":"","details":[]}})");
  EXPECT_EQ(model.known().last_message, "step needs the manual clock");
  model.ask(Action::kPauseOrResume);
  EXPECT_EQ(model.known().last_message, "");
}

TEST(WatchModel, IgnoresTheErrorOfAMissingCamera) {
  WatchModel model = test::watched_model();
  model.handle(
      R"({"op":"result","id":null,"ok":false,"error":{"code":"no_camera","message":"no"}})");
  EXPECT_EQ(model.known().last_message, "");
}

TEST(WatchModel, ReadsBye) {
  WatchModel model = test::watched_model();
  EXPECT_FALSE(model.has_left());
  model.handle(R"({"op":"bye","why":"shutdown","message":"the server is stopping"})");
  EXPECT_TRUE(model.has_left());
  EXPECT_EQ(model.known().last_message, "the server is stopping");
}

TEST(WatchModel, SurvivesMalformedMessages) {
  for (const char* line :
       {"", "{", "[]", "3", "null", "\"text\"", "{\"op\":7}", "{\"op\":\"state\"}",
        "{\"op\":\"state\",\"joints\":7,\"tool\":[],\"blocks\":{},\"io\":3,\"clock\":1}",
        "{\"op\":\"state\",\"joints\":[7,null,{\"label\":3,\"count\":1.5}],\"tool\":null}",
        "{\"op\":\"model\",\"robot\":{\"joints\":[{\"limits\":[1]},{\"limits\":[\"a\",2]},7]}}",
        "{\"op\":\"event\",\"seq\":\"x\",\"line\":{}}", "{\"op\":\"result\"}",
        "{\"op\":\"result\",\"ok\":true,\"value\":[]}",
        "{\"op\":\"result\",\"id\":\"lines\",\"ok\":true,\"value\":{\"lines\":[7],\"device\":1}}",
        "{\"op\":\"image\",\"rows\":{}}",
        "{\"op\":\"hello\",\"channels\":\"state\",\"tick_hz\":0,\"robot\":[]}"}) {
    WatchModel model = test::watched_model();
    EXPECT_NO_THROW(model.handle(line)) << line;
    EXPECT_GE(model.known().tick_hz, 1);
  }
}

}  // namespace
}  // namespace xr3::watch
