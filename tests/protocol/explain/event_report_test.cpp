// Codes and sentences of events; their members are tested with the monitor's messages.
#include "protocol/explain/event_report.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

struct EventRow {
  EventBody event;
  std::string_view code;
  std::string_view sentence;
};

TEST(EventReport, EventsHaveACodeAndAMessage) {
  const EventRow rows[] = {
      {MoveTaken{'E', 50, 62}, "move", "E +50: counter 62"},
      {Reached{'E', 12}, "reached", "E has reached its target"},
      {MotorBlocked{'F', Blocked::kLimit, 'F', true, 175, 771, 4}, "limit",
       "F is at its upper limit of 175 deg, 4 counts short"},
      {MotorBlocked{'A', Blocked::kLimit, 'A', false, 0, -64, -7}, "limit",
       "A is at its lower limit of 0 mm, 7 counts short"},
      {MotorBlocked{'E', Blocked::kLimit, 'D', false, -15, 502, 8}, "limit",
       "E is blocked because it would move D past its lower limit of -15 deg, 8 counts short"},
      {SwitchChanged{'C', true, 40}, "switch", "the microswitch of C closed"},
      {SwitchChanged{'C', false, 39}, "switch", "the microswitch of C opened"},
      {Homed{}, "homed", "soft home"},
      {OutputChanged{3, true}, "io", "output 3 is high"},
      {InputChanged{8, false}, "io", "input 8 is low"},
      {AuxiliaryChanged{2, true}, "io", "auxiliary port 2 is on"},
      {EnabledChanged{true}, "enabled", "the simulator is enabled"},
      {FaultNews{"slip", FaultKind::kEncoderSlip, FaultPhase::kEffect, 3, 'E', 27}, "encoder_slip",
       "fault slip: the encoder of E misses a count at 27"},
      {FaultNews{"jam", FaultKind::kMotorStuck, FaultPhase::kBegan, 0, 'F'}, "motor_stuck",
       "fault jam: the motor of F is stuck"},
      {FaultNews{"jam", FaultKind::kMotorStuck, FaultPhase::kEnded, 0, 'F'}, "motor_stuck",
       "fault jam has ended"},
      {FaultNews{"lost", FaultKind::kReplyLost, FaultPhase::kSet}, "reply_lost",
       "fault lost is set: reply_lost"},
      {FaultNews{"lost", FaultKind::kReplyLost, FaultPhase::kCleared}, "reply_lost",
       "fault lost is cleared"},
      {Warning{WarningCode::kNoSuchJoint, 'G', 0, 0, {}}, "no_such_joint",
       "G: this robot has no such joint; it has A...F"},
      {Warning{WarningCode::kJawsTouch, 'A', 0, 0, "red"}, "jaws_touch",
       "the jaws stopped at the width of block red and do not hold it: close them further"},
      {Warning{WarningCode::kReleasedInAir, 'A', 80'302, 0, "red"}, "released_in_air",
       "block red was released 80.302 mm above the work surface and stays in the air: release it "
       "lower"},
      {Warning{WarningCode::kReleasedInAir, 'A', 2'001, 0, "red", "blue"}, "released_in_air",
       "block red was released 2.001 mm above block blue and stays in the air: release it lower"},
      {Warning{WarningCode::kReleasedInAir, 'A', 9'000, 0, {}}, "released_in_air",
       "the block was released 9 mm above what is below it and stays in the air: release it "
       "lower"},
      {Warning{WarningCode::kBlocksOverlap, 'A', 1, 0, "red", "blue"}, "blocks_overlap",
       "block red overlaps block blue: put it where no block is"},
      {Warning{WarningCode::kBlocksOverlap, 'A', 3, 0, "red", "blue"}, "blocks_overlap",
       "block red overlaps block blue and 2 more: put it where no block is"},
      {Warning{WarningCode::kBlocksOverlap, 'A', 1, 0, {}}, "blocks_overlap",
       "the block overlaps another block: put it where no block is"},
  };
  for (const EventRow& row : rows) {
    const EventReport about = report(row.event, *test::rhino());
    EXPECT_EQ(about.code, row.code);
    EXPECT_EQ(about.message, row.sentence);
  }
}

TEST(EventReport, ListsTheLettersOfTheJoints) {
  Robot robot = test::robot_named("rhino-xr3");
  const std::string letters = "CHBGE";
  for (std::size_t i = 0; i < letters.size(); ++i) robot.joints[i].drive.label = letters[i];
  const EventReport about =
      report(Warning{WarningCode::kNoSuchJoint, 'D', 0, 0, {}}, *test::model_of(robot));
  EXPECT_EQ(about.message, "D: this robot has no such joint; it has A...C, E, G...H");
}

TEST(EventReport, WarningsNameTheCarousel) {
  const ModelPtr model = test::model_of(test::robot_named("rhino-xr3-accessories"));
  const auto sentence = [&](const Warning& warning) { return report(warning, *model).message; };
  EXPECT_EQ(sentence({WarningCode::kReleasedInAir, 'H', 9'000, 0, "red"}),
            "block red was released 9 mm above the carousel and stays in the air: release it "
            "lower");
  EXPECT_EQ(sentence({WarningCode::kReleasedInAir, 'A', 9'000, 0, "red"}),
            "block red was released 9 mm above the work surface and stays in the air: release it "
            "lower");
  EXPECT_EQ(sentence({WarningCode::kBlocksOverlap, 'H', 0, 0, "red"}),
            "block red overlaps the carousel: put it on its top or beside it");
  EXPECT_EQ(sentence({WarningCode::kBelowSurface, 'A', 0, 0, {}}),
            "the tool tip passed under the work surface or the top of the carousel");
  EXPECT_EQ(sentence({WarningCode::kBelowSurface, 'A', 0, 0, {}}),
            report(Warning{WarningCode::kBelowSurface, 'A', 0, 0, {}}, *test::rhino()).message +
                " or the top of the carousel");
}

TEST(EventReport, AStallNamesTheCommandThatEndsIt) {
  for (const Stall why : {Stall::kProtectedRegion, Stall::kWorkSurface}) {
    EXPECT_NE(report(Stalled{why}, *test::rhino()).message.find("A$"), std::string::npos);
  }
  EXPECT_EQ(report(Stalled{Stall::kProtectedRegion}, *test::rhino()).code, "protected_region");
  EXPECT_EQ(report(Stalled{Stall::kWorkSurface}, *test::rhino()).code, "work_surface");
}

TEST(EventReport, AnOverflowNamesTheMoveAndTheCounter) {
  const std::string words =
      report(Warning{WarningCode::kCounterOverflow, 'E', 100, -56, {}}, *test::rhino()).message;
  EXPECT_NE(words.find("E+100"), std::string::npos) << words;
  EXPECT_NE(words.find("-56"), std::string::npos) << words;
}

TEST(EventReport, EveryReasonHasACodeAndAText) {
  const std::pair<LineCloseReason, std::string> rows[] = {
      {LineCloseReason::kClientClosed, "client_closed"},
      {LineCloseReason::kNotARobotProgram, "stranger"},
      {LineCloseReason::kMemory, "memory"},
      {LineCloseReason::kFault, "fault"},
      {LineCloseReason::kError, "error"},
      {LineCloseReason::kShutdown, "shutdown"},
      {LineCloseReason::kDisconnected, "disconnected"},
  };
  for (const auto& [reason, code] : rows) {
    const CellEvent event{0, 0, LineId{4}, LineClosedNote{reason, 0, 0}};
    const EventReport about = report(event, *test::rhino());
    EXPECT_EQ(about.code, code);
    EXPECT_GT(about.message.size(), std::string("line 4 ").size());
  }
  EXPECT_EQ(name_of(LineKind::kTcp), "tcp");
  EXPECT_EQ(name_of(LineKind::kTelnet), "telnet");
  EXPECT_EQ(name_of(LineKind::kRfc2217), "rfc2217");
  EXPECT_EQ(name_of(LineKind::kPty), "pty");
  EXPECT_EQ(name_of(LineKind::kDevice), "device");
  EXPECT_EQ(name_of(LineKind::kMonitor), "monitor");
}

}  // namespace
}  // namespace xr3
