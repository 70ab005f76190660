// Every kind of `event` message: names, order and types of the members, and texts.
#include "protocol/monitor/event.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

std::string shown(CellNote note, std::optional<LineId> line = std::nullopt) {
  return event_json({0, 1300, line, std::move(note)}, *test::rhino()).dump();
}

TEST(EventJson, Move) {
  EXPECT_EQ(shown(EventBody{MoveTaken{'E', 5, 5}}, 3),
            R"({"event":"move","line":3,"code":"move","message":"E +5: counter 5","joint":"E",)"
            R"("counts":5,"error":5})");
}

TEST(EventJson, Reached) {
  EXPECT_EQ(shown(EventBody{Reached{'E', 5}}),
            R"({"event":"reached","line":null,"code":"reached",)"
            R"("message":"E has reached its target","joint":"E","count":5})");
}

TEST(EventJson, Blocked) {
  EXPECT_EQ(shown(EventBody{MotorBlocked{'E', Blocked::kLimit, 'E', true, -15, 660, 12}}),
            R"({"event":"blocked","line":null,"code":"limit",)"
            R"("message":"E is at its upper limit of -15 deg, 12 counts short",)"
            R"("joint":"E","count":660,"error":12,"by":"E"})");
  EXPECT_EQ(shown(EventBody{MotorBlocked{'A', Blocked::kBlock, 0, false, 0, -40, -9}}),
            R"({"event":"blocked","line":null,"code":"block",)"
            R"("message":"the jaws are closed on a block, 9 counts short",)"
            R"("joint":"A","count":-40,"error":-9,"by":"A"})");
}

TEST(EventJson, Stalled) {
  EXPECT_EQ(shown(EventBody{Stalled{Stall::kProtectedRegion}}),
            R"({"event":"stalled","line":null,"code":"protected_region","message":"the tool would )"
            R"(enter the protected region; A$ or reset clears the stall"})");
}

TEST(EventJson, Switch) {
  EXPECT_EQ(shown(EventBody{SwitchChanged{'E', true, -60}}),
            R"({"event":"switch","line":null,"code":"switch",)"
            R"("message":"the microswitch of E closed","joint":"E","closed":true,"count":-60})");
}

TEST(EventJson, GraspedAndReleased) {
  EXPECT_EQ(
      shown(EventBody{Grasped{"red", {250'000, 60'000, 15'000}, 30'000'000}}),
      R"({"event":"grasped","line":null,"code":"grasped","message":"the jaws hold block red",)"
      R"("block":"red","xyz_mm":[250.0,60.0,15.0],"yaw_deg":30.0})");
  EXPECT_EQ(shown(EventBody{Released{"red", {300'001, -40'000, 15'000}, 90'000'040}}),
            R"({"event":"released","line":null,"code":"released","message":"block red released",)"
            R"("block":"red","xyz_mm":[300.001,-40.0,15.0],"yaw_deg":90.0})");
}

TEST(EventJson, HomedByALineOrByACall) {
  EXPECT_EQ(shown(EventBody{Homed{}}, 3),
            R"({"event":"homed","line":3,"code":"homed","message":"soft home by A$",)"
            R"("by":"serial"})");
  EXPECT_EQ(shown(EventBody{Homed{}}),
            R"({"event":"homed","line":null,"code":"homed","message":"soft home by a call",)"
            R"("by":"call"})");
}

TEST(EventJson, IgnoredBytes) {
  RawBytes raw;
  for (const char byte : std::string("E+200\r")) raw.push(static_cast<std::uint8_t>(byte));
  EXPECT_EQ(shown(ProblemNote{"number_out_of_range", "E+200: a move is -128...127 counts; ignored",
                              14, raw, 1},
                  3),
            R"({"event":"warning","line":3,"code":"number_out_of_range",)"
            R"("message":"E+200: a move is -128...127 counts; ignored","offset":14,)"
            R"("hex":"452b3230300d","count":1})");
}

TEST(EventJson, WarningsWithoutBytes) {
  EXPECT_EQ(shown(EventBody{Warning{WarningCode::kBelowSurface, 0, 0, 0, ""}}),
            R"({"event":"warning","line":null,"code":"below_surface",)"
            R"("message":"the tool tip passed under the work surface","offset":null,"hex":null,)"
            R"("count":1})");
  EXPECT_EQ(shown(SuppressedNote{12}, 3),
            R"({"event":"warning","line":3,"code":"suppressed",)"
            R"("message":"12 more warnings of this line in that simulated second","offset":null,)"
            R"("hex":null,"count":12})");
}

TEST(EventJson, LinesOpenAndClose) {
  EXPECT_EQ(shown(LineOpenedNote{LineKind::kTcp, "127.0.0.1:51022"}, 4),
            R"({"event":"line_open","line":4,"code":"line_open",)"
            R"("message":"line 4 opened by 127.0.0.1:51022","kind":"tcp",)"
            R"("peer":"127.0.0.1:51022"})");
  EXPECT_EQ(shown(LineClosedNote{LineCloseReason::kClientClosed, 12, 3}, 4),
            R"({"event":"line_close","line":4,"code":"client_closed",)"
            R"("message":"line 4 closed by its client","bytes_in":12,"bytes_out":3})");
}

TEST(EventJson, LinesWaitAndHaveTheirTurn) {
  EXPECT_EQ(shown(LineTurnNote{1}, 4),
            R"({"event":"line_turn","line":4,"code":"line_waits",)"
            R"("message":"line 4 waits, unread, until line 1 is closed: the byte clock obeys one )"
            R"(line at a time; line_disconnect closes line 1, --concurrent-lines obeys all",)"
            R"("waits_for":1})");
  EXPECT_EQ(shown(LineTurnNote{}, 4), R"({"event":"line_turn","line":4,"code":"line_turn",)"
                                      R"("message":"the turn of line 4 begins","waits_for":null})");
}

TEST(EventJson, TwoLinesMoveOneJoint) {
  EXPECT_EQ(shown(ContestedNote{1, 'E'}, 4),
            R"({"event":"contested","line":4,"code":"contested",)"
            R"("message":"line 4 moves E while it has counts to go from a move of line 1: two )"
            R"(programs move one joint, and the counts of both add up","joint":"E",)"
            R"("other_line":1})");
}

TEST(EventJson, CellsOpenAndClose) {
  EXPECT_EQ(
      shown(CellOpenedNote{"c3"}),
      R"({"event":"cell_opened","line":null,"code":"cell_opened","message":"cell c3 opened"})");
  EXPECT_EQ(
      shown(CellClosedNote{"c3"}),
      R"({"event":"cell_closed","line":null,"code":"cell_closed","message":"cell c3 closed"})");
}

TEST(EventJson, TheClock) {
  EXPECT_EQ(shown(ClockNote{"resume", ClockMode::kBytes, {}}),
            R"({"event":"clock","line":null,"code":"resume",)"
            R"~("message":"time moves with the bytes of the lines (resume)",)~"
            R"("clock":{"mode":"bytes","rate":1.0}})");
  EXPECT_EQ(shown(ClockNote{"pause", ClockMode::kManual, {}}),
            R"~({"event":"clock","line":null,"code":"pause","message":"time is paused (pause)",)~"
            R"("clock":{"mode":"manual","rate":1.0}})");
  EXPECT_EQ(shown(ClockNote{"rate", ClockMode::kReal, {2'500'000}}),
            R"({"event":"clock","line":null,"code":"rate",)"
            R"~("message":"time runs at 2.5 times real time (rate)",)~"
            R"("clock":{"mode":"real","rate":2.5}})");
  EXPECT_EQ(shown(ClockNote{"rate", ClockMode::kManual, {10'000'000}}),
            R"({"event":"clock","line":null,"code":"rate",)"
            R"~("message":"time is paused; it will run at 10 times real time (rate)",)~"
            R"("clock":{"mode":"manual","rate":10.0}})");
}

TEST(EventJson, DigitalLines) {
  EXPECT_EQ(shown(EventBody{OutputChanged{2, true}}, 3),
            R"({"event":"io","line":3,"code":"io","message":"output 2 is high","output":2,)"
            R"("value":true})");
  EXPECT_EQ(shown(EventBody{InputChanged{7, false}}),
            R"({"event":"io","line":null,"code":"io","message":"input 7 is low","input":7,)"
            R"("value":false})");
  EXPECT_EQ(shown(EventBody{AuxiliaryChanged{1, true}}, 3),
            R"({"event":"io","line":3,"code":"io","message":"auxiliary port 1 is on","aux":1,)"
            R"("value":true})");
}

TEST(EventJson, ModelAndEpoch) {
  EXPECT_EQ(shown(ModelNote{"block_add", "green", 2}),
            R"({"event":"model","line":null,"code":"block_add",)"
            R"("message":"workcell changed: block_add green","model_rev":2})");
  EXPECT_EQ(event_json({1, 0, std::nullopt, EpochNote{"reset", 0, 1300}}, *test::rhino()).dump(),
            R"({"event":"epoch","line":null,"code":"reset",)"
            R"("message":"reset: tick 1300 of epoch 0 became tick 0 of epoch 1","from_epoch":0,)"
            R"("from_tick":1300})");
}

TEST(EventJson, Enabled) {
  EXPECT_EQ(shown(EventBody{EnabledChanged{false}}, 3),
            R"({"event":"enabled","line":3,"code":"disabled",)"
            R"("message":"the simulator is disabled; only A@ is executed","enabled":false})");
}

TEST(EventJson, EnabledWithADevice) {
  const auto message = [](const HandoverNote& note) {
    const Json event = event_json({0, 1, LineId{3}, note}, *test::rhino());
    EXPECT_EQ(event["event"], "enabled");
    EXPECT_EQ(event["code"], note.enabled ? "enabled" : "disabled");
    EXPECT_EQ(event["enabled"], note.enabled);
    return event["message"].get<std::string>();
  };
  EXPECT_EQ(message({true, "/dev/arm"}),
            "the simulator is enabled; device /dev/arm gets no command");
  EXPECT_EQ(message({false, "/dev/arm"}),
            "the simulator is disabled; commands go to device /dev/arm");
  EXPECT_EQ(
      message({false, "/dev/arm", false}),
      "the simulator is disabled; commands go to device /dev/arm, which is not there: they are "
      "dropped");
  EXPECT_EQ(message({false, "/dev/arm", true, true}),
            "the simulator is disabled; commands go to device /dev/arm, and the simulation carries "
            "them out, too");
}

}  // namespace
}  // namespace xr3
