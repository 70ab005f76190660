// The monitor service in memory: requests, subscriptions and calls of sessions without a
// connection, and their output. The clock is manual except where a test says otherwise.
#include "server/service/service.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/net/wall_clock.hpp"
#include "server/service/open_session.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

AccessPolicy with_token(ReadAccess reading) {
  AccessRules rules;
  rules.token = "sixteen-letters!";
  rules.reading = reading;
  return AccessPolicy(rules);
}

/// A sink without a connection: the tests read the output of the session themselves.
struct NullSink final : MessageSink {
  void pump() override {}
};

class MonitorServiceTest : public testing::Test {
 protected:
  explicit MonitorServiceTest(AccessPolicy policy = {}) : policy_(std::move(policy)) {}

  /// Passes a message to the session; returns all output.
  std::vector<Json> ask(OpenSession& session, const std::string& message) {
    begin(session, message);
    io_.restart();
    io_.poll();
    return read(session);
  }
  /// Expects exactly one message as the answer and returns it.
  Json answer(OpenSession& session, const std::string& message) {
    const std::vector<Json> answers = ask(session, message);
    EXPECT_EQ(answers.size(), 1U) << message;
    return answers.empty() ? Json() : answers.front();
  }
  Json call(OpenSession& session, const std::string& fn, const std::string& args = "{}") {
    return answer(session, R"({"op":"call","id":1,"fn":")" + fn + R"(","args":)" + args + "}");
  }
  /// Passes a message to the session, and does not wait for its answer.
  void begin(OpenSession& session, const std::string& message) {
    asio::co_spawn(
        io_, [&session, message] { return session.handle(message); }, asio::detached);
  }
  std::vector<Json> read(MonitorSession& session) {
    std::vector<Json> messages;
    while (const monitor::Message message = session.next_output())
      messages.push_back(Json::parse(*message));
    return messages;
  }
  /// Runs the loop until there is output.
  std::vector<Json> wait(MonitorSession& session) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    for (;;) {
      std::vector<Json> messages = read(session);
      if (!messages.empty() || std::chrono::steady_clock::now() > deadline) return messages;
      io_.restart();
      io_.run_one_for(20ms);
    }
  }
  void send(const std::string& bytes) {
    if (line_ == 0) line_ = cell_.apply(LineOpened{"test"}, wall_now()).line;
    cell_.apply(BytesIn{line_, bytes}, wall_now());
    hosted_.after_input();
  }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  HostedCell& hosted_ = host_.add(test::rhino());
  Cell& cell_ = hosted_.cell();
  AccessPolicy policy_;
  MonitorService service_{io_, host_.cells, host_.worker, policy_};
  NullSink sink_;
  OpenSession one_{service_, sink_};
  LineId line_ = 0;
};

TEST_F(MonitorServiceTest, SubReturnsItsSettingsAndThenTheFirstFrame) {
  read(one_);
  const auto answers =
      ask(one_, R"({"op":"sub","id":2,"channel":"state","max_hz":20,"fields":["moving"]})");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(
      answers[0]["value"].dump(),
      R"({"cell":"main","channel":"state","max_hz":20.0,"on_change":true,"fields":["moving"]})");
  EXPECT_EQ(answers[1].dump(),
            R"({"op":"state","cell":"main","epoch":0,"seq":1,"tick":0,"moving":false})");
}

// --- Several cells.

TEST_F(MonitorServiceTest, ARequestGoesToTheCellThatItNames) {
  HostedCell& second = host_.add(test::rhino(), "second");
  read(one_);
  answer(one_, R"({"op":"call","id":1,"cell":"second","fn":"reset","args":{}})");
  EXPECT_EQ(second.cell().epoch(), 1);
  EXPECT_EQ(cell_.epoch(), 0);
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"model","cell":"second"})")["cell"], "second");
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"model"})")["cell"], "main");
}

TEST_F(MonitorServiceTest, AnUnknownCellIsAnError) {
  read(one_);
  const Json error = answer(one_, R"({"op":"ping","id":4,"cell":"third"})")["error"];
  EXPECT_EQ(error["code"], "unknown_cell");
  EXPECT_EQ(error["message"], R"(there is no cell "third")");
  EXPECT_EQ(error["hint"], R"(there is "main")");
  host_.add(test::rhino(), "first");
  EXPECT_EQ(answer(one_, R"({"op":"ping","cell":"frist"})")["error"]["hint"],
            R"(there is "main" or "first"; perhaps "first" was meant)");
}

TEST_F(MonitorServiceTest, ASubscriptionGetsTheMessagesOfItsCell) {
  HostedCell& second = host_.add(test::rhino(), "second");
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event","cell":"second"})");
  send("E+5\r");
  io_.restart();
  io_.run_for(50ms);
  EXPECT_TRUE(read(one_).empty());
  EXPECT_EQ(second.hub().sessions().size(), 1U);
  EXPECT_EQ(hosted_.hub().sessions().size(), 0U);
  second.cell().apply(LineOpened{"test"}, wall_now());
  second.after_input();
  EXPECT_EQ(wait(one_).front()["cell"], "second");
  ask(one_, R"({"op":"unsub","channel":"event","cell":"second"})");
  EXPECT_EQ(second.hub().sessions().size(), 0U);
}

TEST_F(MonitorServiceTest, TheSubscriptionsOfAClosedCellEndWithItsLastEvent) {
  HostedCell& second = host_.add(test::rhino(), "second");
  const CellPtr kept = second.shared_from_this();
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event","cell":"second"})");
  ask(one_, R"({"op":"sub","channel":"state","cell":"second"})");
  second.cell().report_closed();
  service_.forget(second);
  host_.cells.remove(second);
  kept->retire();
  const std::vector<Json> rest = read(one_);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0]["event"], "cell_closed");
  EXPECT_FALSE(one_.client().follows_anything());
  EXPECT_EQ(kept->hub().sessions().size(), 0U);
  EXPECT_EQ(answer(one_, R"({"op":"ping","cell":"second"})")["error"]["code"], "unknown_cell");
}

TEST_F(MonitorServiceTest, ACallThatWaitsForAClosedCellFails) {
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
  service_.forget(second);
  host_.cells.remove(second);
  kept->retire();
  const std::vector<Json> answers = wait(one_);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_FALSE(answers[0]["ok"]);
}

TEST_F(MonitorServiceTest, CountersAreSumsAndKeepThoseOfClosedCells) {
  HostedCell& second = host_.add(test::rhino(), "second");
  const CellPtr kept = second.shared_from_this();
  second.cell().apply(LineOpened{"test"}, wall_now());
  send("E?");
  EXPECT_EQ(service_.counters().lines_total, 2U);
  EXPECT_EQ(service_.counters().lines_open, 2U);
  service_.forget(second);
  host_.cells.remove(second);
  kept->retire();
  EXPECT_EQ(service_.counters().lines_total, 2U);
  EXPECT_EQ(service_.counters().lines_open, 1U);
  EXPECT_EQ(service_.counters().cells_open, 1U);
  EXPECT_EQ(service_.counters().cells_total, 2U);
}

TEST_F(MonitorServiceTest, ManyCellsTogetherAreBoundedByTheMemory) {
  MemoryLimit limit(io_, 1, [] { return 0; });
  service_.calls().limit_memory(limit);
  read(one_);
  EXPECT_TRUE(call(one_, "snapshot_save", R"({"name":"a"})")["ok"])
      << "one cell has its own limits";
  host_.add(test::rhino(), "second");
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"b"})")["error"]["code"], "limit");
  EXPECT_TRUE(call(one_, "reset")["ok"]);
  EXPECT_TRUE(call(one_, "snapshot_save", R"({"inline":true})")["ok"]);
}

TEST_F(MonitorServiceTest, ASessionHasAFewLinesAndSubscriptions) {
  for (std::size_t i = 0; i < MonitorChannels::kMaxSubscriptions; ++i)
    host_.add(test::rhino(), std::to_string(i));
  read(one_);
  const auto at = [](std::size_t cell) { return R"(,"cell":")" + std::to_string(cell) + "\"}"; };
  for (std::size_t i = 0; i < MonitorChannels::kMaxSubscriptions; ++i)
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

TEST_F(MonitorServiceTest, WithoutACellOnlyTheServerAnswers) {
  host_.cells.remove(hosted_);
  OpenSession other(service_, sink_);
  const std::vector<Json> hello = read(other);
  EXPECT_TRUE(hello.at(0)["cell"].is_null());
  EXPECT_TRUE(hello.at(0)["robot"].is_null());
  EXPECT_EQ(answer(other, R"({"op":"ping","id":1})")["op"], "pong");
  EXPECT_TRUE(call(other, "describe")["value"]["tick"].is_null());
  const Json error = answer(other, R"({"op":"get","channel":"state"})")["error"];
  EXPECT_EQ(error["code"], "unknown_cell");
}

TEST_F(MonitorServiceTest, TheOverviewShowsAllCellsAndThenChanges) {
  HostedCell& second = host_.add(test::rhino(), "second");
  host_.on_input = [this](HostedCell& cell) { service_.overview().changed(cell); };
  read(one_);
  const std::vector<Json> answers = ask(one_, R"({"op":"sub","channel":"overview"})");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_TRUE(answers[1]["whole"]);
  EXPECT_EQ(answers[1]["cells"].size(), 2U);
  second.cell().apply(LineOpened{"test"}, wall_now());
  second.after_input();
  const Json change = wait(one_).back();
  EXPECT_FALSE(change["whole"]);
  ASSERT_EQ(change["cells"].size(), 1U);
  EXPECT_EQ(change["cells"][0]["name"], "second");
  EXPECT_EQ(change["cells"][0]["lines"], 1);
  const CellPtr kept = second.shared_from_this();
  service_.forget(second);
  host_.cells.remove(second);
  kept->retire();
  EXPECT_EQ(wait(one_).back()["closed"].dump(), R"(["second"])");
}

TEST_F(MonitorServiceTest, AtRestTheOverviewIsIdle) {
  ask(one_, R"({"op":"sub","channel":"overview"})");
  io_.restart();
  io_.run_for(700ms);
  read(one_);
  io_.restart();
  EXPECT_EQ(io_.run_for(300ms), 0U);
}

TEST_F(MonitorServiceTest, SendsOnlyChanges) {
  read(one_);
  ask(one_, R"({"op":"sub","channel":"state","fields":["moving","io"],"max_hz":60})");
  send("E?");
  io_.restart();
  io_.run_for(60ms);
  EXPECT_TRUE(read(one_).empty()) << "an inquiry changes nothing";
  send("P3");
  const auto changes = wait(one_);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0]["io"]["outputs"][2], true);
}

TEST_F(MonitorServiceTest, AtRestTheLoopIsIdle) {
  ask(one_, R"({"op":"sub","channel":"state"})");
  ask(one_, R"({"op":"sub","channel":"event"})");
  io_.restart();
  io_.run_for(100ms);
  read(one_);
  io_.restart();
  EXPECT_EQ(io_.run_for(100ms), 0U);
}

TEST_F(MonitorServiceTest, TheSameSeqHasTheSameBytes) {
  OpenSession other(service_, sink_);
  read(one_);
  read(other);
  const std::string sub = R"({"op":"sub","channel":"model"})";
  const auto first = ask(one_, sub);
  send("E+5\r");
  cell_.apply(call::Call{call::Step{100}}, wall_now());
  const auto second = ask(other, sub);
  EXPECT_EQ(first.at(1).dump(), second.at(1).dump());
}

TEST_F(MonitorServiceTest, EventsAreInOrderWithTheirTicks) {
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event"})");
  send("E+2\r");
  const auto messages =
      ask(one_, R"({"op":"call","id":1,"fn":"step","args":{"ticks":100,"fields":[]}})");
  ASSERT_EQ(messages.size(), 4U) << "the answer, then the events";
  EXPECT_EQ(messages[0]["op"], "result");
  EXPECT_EQ(messages[1]["event"], "line_open");
  EXPECT_EQ(messages[2]["event"], "move");
  EXPECT_EQ(messages[3]["event"], "reached");
  EXPECT_EQ(messages[3]["tick"], 19);
  const auto again = ask(one_, R"({"op":"get","id":7,"channel":"event","since":3})");
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0]["event"], "reached");
  EXPECT_EQ(again[0]["id"], 7);
  EXPECT_EQ(again[1]["ok"], true);
}

TEST_F(MonitorServiceTest, SendOpensALineThatClosesWithTheSession) {
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

TEST_F(MonitorServiceTest, ACallDoesNotWaitForAHistory) {
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

TEST_F(MonitorServiceTest, SendPassesBytesUnchanged) {
  read(one_);
  const Json value = call(one_, "send", R"({"text":"GET / HTTP/1.1\r\n\r\n"})")["value"];
  EXPECT_EQ(cell_.lines().at(value["line"]).bytes_in(), 18U) << "HTTP is not detected here";
}

TEST_F(MonitorServiceTest, SendStopsAtAFullOutbox) {
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

TEST_F(MonitorServiceTest, PauseOfAManualClockSendsNoEvent) {
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event"})");
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"pause"})").size(), 1U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"resume"})").size(), 2U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"resume"})").size(), 1U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"pause"})").size(), 2U);
}

TEST_F(MonitorServiceTest, AFutureSinceStartsNow) {
  read(one_);
  const Json value = answer(one_, R"({"op":"sub","channel":"event","since":100000})")["value"];
  EXPECT_EQ(value["since"], cell_.events().next());
}

TEST_F(MonitorServiceTest, LinesListsAndLineDisconnectCloses) {
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

TEST_F(MonitorServiceTest, AddsAndRemovesBlocks) {
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

TEST_F(MonitorServiceTest, ALoadedSnapshotContinuesIdentically) {
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

TEST_F(MonitorServiceTest, KeepsAtMostSixteenSnapshots) {
  read(one_);
  for (int i = 0; i < 16; ++i) {
    const std::string name = R"({"name":"s)" + std::to_string(i) + R"("})";
    EXPECT_EQ(call(one_, "snapshot_save", name)["ok"], true);
  }
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"one more"})")["error"]["code"], "limit");
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"s3"})")["ok"], true);
  EXPECT_EQ(call(one_, "snapshot_load", R"({"name":"?"})")["error"]["code"], "no_such_snapshot");
}

TEST_F(MonitorServiceTest, KeysWorkWhileTheSimulatorIsDisabled) {
  read(one_);
  EXPECT_EQ(call(one_, "key", R"({"function":"enabled"})")["ok"], true);
  EXPECT_FALSE(cell_.state().enabled);
  EXPECT_EQ(call(one_, "key", R"({"function":"display"})")["ok"], true);
  EXPECT_TRUE(cell_.state().display.on);
}

class WithToken : public MonitorServiceTest {
 protected:
  WithToken() : MonitorServiceTest(with_token(ReadAccess::kFree)) {}
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

class Private : public MonitorServiceTest {
 protected:
  Private() : MonitorServiceTest(with_token(ReadAccess::kWithToken)) {}
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
