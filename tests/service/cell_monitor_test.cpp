// The monitor of a cell without a server.
#include "service/cell_monitor.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/cell_monitor_fixture.hpp"

namespace xr3 {
namespace {

using CellMonitorTest = test::CellMonitorFixture;

TEST_F(CellMonitorTest, GreetsTheClientWithTheCell) {
  service::CellMonitor other("xr3 1.2", cell_, nullptr);
  const Json hello = Json::parse(*other.next_output(0));
  EXPECT_EQ(hello["op"], "hello");
  EXPECT_EQ(hello["server"], "xr3 1.2");
  EXPECT_EQ(hello["cells"], Json::array({"main"}));
  EXPECT_EQ(hello["access"], "control");
}

TEST_F(CellMonitorTest, AnInvalidRequestIsAnsweredByAnError) {
  EXPECT_EQ(answer(R"({"op":"nothing","id":7})")["error"]["code"], "unknown_op");
  EXPECT_EQ(answer(R"({"op":"get","channel":"state","cell":"other"})")["error"]["code"],
            "unknown_cell");
}

TEST_F(CellMonitorTest, ARobotIsDrivenAndWatched) {
  const std::vector<Json> first = ask(R"({"op":"sub","channel":"state","fields":["moving"]})");
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0]["value"]["channel"], "state");
  EXPECT_EQ(first[1]["moving"], false);
  EXPECT_EQ(call("send", R"({"text":"E+5\rE?"})")["value"]["text"], "%");
  EXPECT_EQ(wait().at(0)["moving"], true);
  EXPECT_EQ(call("step", R"({"ticks":1000})")["value"]["tick"], 1000);
  EXPECT_EQ(wait().at(0)["moving"], false);
  EXPECT_TRUE(wait().empty()) << "nothing has changed";
  ask(R"({"op":"unsub","channel":"state"})");
  call("send", R"({"text":"P3"})");
  EXPECT_TRUE(wait().empty());
}

TEST_F(CellMonitorTest, TheLineOfSendIsOneOfTheLines) {
  const Json line = call("send", R"({"text":"E?"})")["value"]["line"];
  EXPECT_EQ(call("lines")["value"]["lines"][0]["line"], line);
  EXPECT_EQ(call("line_disconnect", R"({"line":)" + line.dump() + "}")["ok"], true);
  EXPECT_TRUE(call("lines")["value"]["lines"].empty());
  EXPECT_EQ(call("line_disconnect", R"({"line":)" + line.dump() + "}")["error"]["code"],
            "no_such_line");
  EXPECT_NE(call("send", R"({"text":"E?"})")["value"]["line"], line) << "a new one";
}

TEST_F(CellMonitorTest, ThePastIsShownAndTakenUp) {
  call("send", R"({"text":"E+50\r"})");
  call("step", R"({"ticks":2000})");
  EXPECT_EQ(call("history")["value"]["epochs"][0]["to"], 2000);
  const std::vector<Json> look =
      ask(R"({"op":"call","id":2,"fn":"look","args":{"tick":100,"channels":["state"]}})");
  ASSERT_EQ(look.size(), 2U);
  EXPECT_EQ(look[0]["past"], true);
  EXPECT_EQ(look[0]["tick"], 100);
  EXPECT_EQ(call("live")["value"]["tick"], 2000);
  EXPECT_FALSE(call("trace", R"({"tick":0,"every":100})")["value"]["states"].empty());
  EXPECT_EQ(call("seek", R"({"tick":100})")["value"]["tick"], 100);
  EXPECT_EQ(cell_->state().tick, 100);
  EXPECT_EQ(call("seek", R"({"tick":9000})")["error"]["code"], "not_kept");
}

TEST_F(CellMonitorTest, WithoutAHistoryThereIsNoPast) {
  service::CellMonitor other("xr3 test", cell_, nullptr);
  other.next_output(0);
  other.handle(R"({"op":"call","id":1,"fn":"history"})", 0);
  EXPECT_EQ(Json::parse(*other.next_output(0))["error"]["code"], "no_history");
}

TEST_F(CellMonitorTest, WhatNeedsAServerIsRefused) {
  for (const char* request : {
           R"({"op":"sub","channel":"overview"})",
           R"({"op":"unsub","channel":"overview"})",
           R"({"op":"get","channel":"overview"})",
           R"({"op":"call","id":1,"fn":"peer_release"})",
           R"({"op":"call","id":1,"fn":"branch","args":{"tick":0}})",
           R"({"op":"call","id":1,"fn":"step","args":{"ticks":1,"after":{"line":1,"bytes_in":1}}})",
       })
    EXPECT_EQ(answer(request)["error"]["code"], "no_server") << request;
  EXPECT_EQ(call("cells")["value"]["cells"][0]["name"], "main");
  EXPECT_EQ(call("describe", R"({"fn":"step"})")["ok"], true);
  EXPECT_EQ(answer(R"({"op":"auth","token":"any"})")["value"]["access"], "control");
}

TEST_F(CellMonitorTest, NoRequestIsTakenWhileTheQueueIsFull) {
  while (!monitor_.is_full()) monitor_.handle(R"({"op":"ping"})", now_);
  monitor_.handle(R"({"op":"call","id":1,"fn":"step","args":{"ticks":5}})", now_);
  EXPECT_EQ(cell_->state().tick, 0);
  read();
  EXPECT_FALSE(monitor_.is_full());
}

}  // namespace
}  // namespace xr3
