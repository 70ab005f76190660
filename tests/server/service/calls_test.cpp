// Calls on a cell and its lines. The clock is manual except where a test says otherwise.
#include "server/service/calls.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "service/channels.hpp"
#include "tests/support/monitor_fixture.hpp"

namespace xr3 {
namespace {

using MonitorCallsTest = test::MonitorFixture;

TEST_F(MonitorCallsTest, ACallThatWaitsForAClosedCellFails) {
  HostedCell& second = host_.add(test::rhino(), "second");
  const CellPtr kept = second.shared_from_this();
  const LineId line = second.cell().apply(LineOpened{"test"}, wall_now()).line;
  read(one_);
  EXPECT_TRUE(
      ask(one_, R"({"op":"call","id":1,"cell":"second","fn":"step","args":{"ticks":1,"after":)"
                R"({"line":)" +
                    std::to_string(line) + R"(,"bytes_in":9,"within_ms":60000}}})")
          .empty());
  second.cell().apply(LineClosed{line, LineCloseReason::kDisconnected}, wall_now());
  service_.remove_cell(second);
  host_.cells.remove(second);
  kept->retire();
  const std::vector<Json> answers = wait(one_);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_FALSE(answers[0]["ok"]);
}

TEST_F(MonitorCallsTest, ASessionHasAFewLinesAndSubscriptions) {
  for (std::size_t i = 0; i < service::kMaxSubscriptions; ++i)
    host_.add(test::rhino(), std::to_string(i));
  read(one_);
  const auto at = [](std::size_t cell) { return R"(,"cell":")" + std::to_string(cell) + "\"}"; };
  for (std::size_t i = 0; i < service::kMaxSubscriptions; ++i)
    EXPECT_TRUE(ask(one_, R"({"op":"sub","channel":"event")" + at(i)).at(0)["ok"]);
  EXPECT_EQ(answer(one_, R"({"op":"sub","channel":"line")" + at(0))["error"]["code"], "limit");
  EXPECT_TRUE(answer(one_, R"({"op":"sub","channel":"event")" + at(0))["ok"]) << "it replaces one";
  const std::string send = R"({"op":"call","fn":"send","args":{"text":""})";
  for (std::size_t i = 0; i < MonitorCalls::kMaxOwnLines; ++i) ask(one_, send + at(i));
  const std::string more = send + at(MonitorCalls::kMaxOwnLines);
  EXPECT_EQ(answer(one_, more)["error"]["code"], "limit");
  host_.cells.find("0")->cell().apply(LineClosed{1, LineCloseReason::kDisconnected}, wall_now());
  EXPECT_TRUE(ask(one_, more).at(0)["ok"]) << "events follow";
}

TEST_F(MonitorCallsTest, SendOpensALineThatClosesWithTheSession) {
  {
    OpenSession other(service_, sink_);
    read(other);
    const Json value = call(other, "send", R"({"text":"E+5\rE?"})")["value"];
    EXPECT_EQ(value["hex"], "25");
    EXPECT_EQ(value["text"], "%");
    EXPECT_EQ(call(other, "send", R"({"text":"I"})")["value"]["line"], value["line"]);
    EXPECT_EQ(cell_.lines().size(), 1U);
  }
  EXPECT_TRUE(cell_.lines().empty());
}

TEST_F(MonitorCallsTest, ACallDoesNotWaitForAHistory) {
  hosted_.keep_history(kTickHz);
  OpenSession other{service_, sink_};
  for (int i = 0; i < 300; ++i) cell_.apply(LineOpened{"test"}, wall_now());  // an event each
  read(one_);
  read(other);
  begin(one_, R"({"op":"call","id":1,"fn":"history","args":{}})");
  begin(other, R"({"op":"call","id":2,"fn":"home","args":{}})");
  EXPECT_EQ(wait(other).front()["ok"], true);
  EXPECT_TRUE(read(one_).empty()) << "its events are read in pieces";
  EXPECT_FALSE(wait(one_).front()["value"]["events"].empty());
}

TEST_F(MonitorCallsTest, SendPassesBytesUnchanged) {
  read(one_);
  const Json value = call(one_, "send", R"({"text":"GET / HTTP/1.1\r\n\r\n"})")["value"];
  EXPECT_EQ(cell_.lines().at(value["line"]).bytes_in(), 18U) << "HTTP is not detected here";
}

TEST_F(MonitorCallsTest, SendStopsAtAFullOutbox) {
  cell_.apply(call::ReplaceWorkcell{test::workcell_named("rhino-xr3")}, wall_now());
  read(one_);
  std::string images;
  for (int i = 0; i < 100; ++i) images += "A**";
  const std::string request = R"({"op":"call","id":1,"fn":"send","args":{"text":")" + images;
  const Json value = answer(one_, request + R"("}})")["value"];
  const auto taken = value["taken"].get<std::size_t>();
  const std::size_t replies = value["hex"].get_ref<const std::string&>().size() / 2;
  EXPECT_LT(taken, images.size());
  EXPECT_GE(replies, SerialLine::kFullOutbox);
  EXPECT_LT(replies, 2 * SerialLine::kFullOutbox) << "each image is smaller than an outbox";
  EXPECT_FALSE(call(one_, "send", R"({"text":"E?"})")["value"].contains("taken"));
}

TEST_F(MonitorCallsTest, LinesListsAndLineDisconnectCloses) {
  read(one_);
  send("E+200\rI");
  const Json lines = call(one_, "lines")["value"]["lines"];
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["bytes_in"], 7);
  EXPECT_EQ(lines[0]["bytes_out"], 0) << "the reply has not been sent";
  EXPECT_EQ(lines[0]["warnings"], 1);
  EXPECT_EQ(lines[0]["last"], "I");
  EXPECT_EQ(call(one_, "line_disconnect", R"({"line":1})")["ok"], true);
  EXPECT_EQ(call(one_, "line_disconnect", R"({"line":1})")["error"]["code"], "no_such_line");
}

TEST_F(MonitorCallsTest, AddsAndRemovesBlocks) {
  read(one_);
  const std::string add =
      R"({"name":"cube","size_mm":[20,20,20],"xyz_mm":[300,0,10],"yaw_deg":30,"color":2})";
  EXPECT_EQ(call(one_, "block_add", add)["ok"], true);
  EXPECT_EQ(call(one_, "block_add", add)["error"]["code"], "name_taken");
  EXPECT_EQ(call(one_, "block_move", R"({"name":"cube","yaw_deg":-10})")["ok"], true);
  EXPECT_EQ(cell_.state().blocks.back().yaw_udeg, -10'000'000);
  EXPECT_EQ(cell_.state().blocks.back().centroid_um, (PointUm{300'000, 0, 10'000}));
  EXPECT_EQ(call(one_, "block_remove", R"({"name":"cube"})")["ok"], true);
  EXPECT_EQ(call(one_, "block_remove", R"({"name":"cube"})")["error"]["code"], "no_such_block");
  EXPECT_EQ(cell_.model_rev(), 4);
}

TEST_F(MonitorCallsTest, ALoadedSnapshotContinuesIdentically) {
  read(one_);
  send("E+50\rF-20\r");
  call(one_, "step", R"({"ticks":77,"fields":[]})");
  const Json saved = call(one_, "snapshot_save", R"({"name":"a"})")["value"];
  const Json inlined = call(one_, "snapshot_save", R"({"inline":true})")["value"];
  EXPECT_EQ(saved["hash"], inlined["hash"]);
  const State before = cell_.state();
  call(one_, "block_remove", R"({"name":"red"})");
  call(one_, "step", R"({"ticks":1000,"fields":[]})");
  const State after = cell_.state();
  const Json loaded = call(one_, "snapshot_load", R"({"name":"a"})")["value"];
  EXPECT_EQ(loaded["hash"], saved["hash"]);
  EXPECT_EQ(loaded["epoch"], 1);
  EXPECT_EQ(loaded["tick"], 77);
  EXPECT_EQ(cell_.state(), before);
  call(one_, "block_remove", R"({"name":"red"})");
  call(one_, "step", R"({"ticks":1000,"fields":[]})");
  EXPECT_EQ(cell_.state(), after);
  const Json again = call(one_, "snapshot_load", Json({{"snapshot", inlined["snapshot"]}}).dump());
  EXPECT_EQ(again["value"]["hash"], saved["hash"]) << again.dump();
  EXPECT_EQ(cell_.state(), before);
}

TEST_F(MonitorCallsTest, KeepsAtMostSixteenSnapshots) {
  read(one_);
  for (int i = 0; i < 16; ++i) {
    const std::string name = R"({"name":"s)" + std::to_string(i) + R"("})";
    EXPECT_EQ(call(one_, "snapshot_save", name)["ok"], true);
  }
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"one more"})")["error"]["code"], "limit");
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"s3"})")["ok"], true);
  EXPECT_EQ(call(one_, "snapshot_load", R"({"name":"?"})")["error"]["code"], "no_such_snapshot");
}

TEST_F(MonitorCallsTest, KeysWorkWhileTheSimulatorIsDisabled) {
  read(one_);
  EXPECT_EQ(call(one_, "key", R"({"function":"enabled"})")["ok"], true);
  EXPECT_FALSE(cell_.state().enabled);
  EXPECT_EQ(call(one_, "key", R"({"function":"display"})")["ok"], true);
  EXPECT_TRUE(cell_.state().display.on);
}

}  // namespace
}  // namespace xr3
