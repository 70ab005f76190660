// Subscriptions and their messages. The clock is manual except where a test says otherwise.
#include "server/service/channels.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/support/monitor_fixture.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

using MonitorChannelsTest = test::MonitorFixture;

TEST_F(MonitorChannelsTest, SubReturnsItsSettingsAndThenTheFirstFrame) {
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

TEST_F(MonitorChannelsTest, ASubscriptionGetsTheMessagesOfItsCell) {
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

TEST_F(MonitorChannelsTest, TheSubscriptionsOfAClosedCellEndWithItsLastEvent) {
  HostedCell& second = host_.add(test::rhino(), "second");
  const CellPtr kept = second.shared_from_this();
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event","cell":"second"})");
  ask(one_, R"({"op":"sub","channel":"state","cell":"second"})");
  second.cell().report_closed();
  service_.remove_cell(second);
  host_.cells.remove(second);
  kept->retire();
  const std::vector<Json> rest = read(one_);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0]["event"], "cell_closed");
  EXPECT_FALSE(one_.client().follows_anything());
  EXPECT_EQ(kept->hub().sessions().size(), 0U);
  EXPECT_EQ(answer(one_, R"({"op":"ping","cell":"second"})")["error"]["code"], "unknown_cell");
}

TEST_F(MonitorChannelsTest, SendsOnlyChanges) {
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

TEST_F(MonitorChannelsTest, AtRestTheLoopIsIdle) {
  ask(one_, R"({"op":"sub","channel":"state"})");
  ask(one_, R"({"op":"sub","channel":"event"})");
  io_.restart();
  io_.run_for(100ms);
  read(one_);
  io_.restart();
  EXPECT_EQ(io_.run_for(100ms), 0U);
}

TEST_F(MonitorChannelsTest, TheSameSeqHasTheSameBytes) {
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

TEST_F(MonitorChannelsTest, EventsAreInOrderWithTheirTicks) {
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

TEST_F(MonitorChannelsTest, PauseOfAManualClockSendsNoEvent) {
  read(one_);
  ask(one_, R"({"op":"sub","channel":"event"})");
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"pause"})").size(), 1U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"resume"})").size(), 2U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"resume"})").size(), 1U);
  EXPECT_EQ(ask(one_, R"({"op":"call","id":1,"fn":"pause"})").size(), 2U);
}

TEST_F(MonitorChannelsTest, AFutureSinceStartsNow) {
  read(one_);
  const Json value = answer(one_, R"({"op":"sub","channel":"event","since":100000})")["value"];
  EXPECT_EQ(value["since"], cell_.events().next());
}

}  // namespace
}  // namespace xr3
