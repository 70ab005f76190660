// The effect of each command on the state, and that it has no other effect.
#include "core/execute.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::rhino;
using test::Rig;
using test::roomy_rhino;

// A robot in motion: three motors running; speeds, lines and settings changed.
Rig busy_rig() {
  Rig rig(roomy_rhino());
  for (const Command& command :
       {Command{SetSpeed{'E', 77}}, Command{SetSpeed{'A', 9}}, Command{Move{'E', 50}},
        Command{Move{'D', -60}}, Command{Move{'A', 5}}, Command{SetOutput{3, true}},
        Command{SetOutput{8, true}}, Command{SetAuxiliary{1, true}}, Command{ToggleDisplay{}},
        Command{SetViewVector{1, -2, 3}}, Command{SetRefreshPeriod{20}}, Command{ToggleErasing{}},
        Command{SelectStatus{4}}, Command{ToggleFunctionKeys{}}}) {
    rig.execute(command);
  }
  rig.simulation.set_input(2, true);
  rig.pass(300);
  rig.simulation.take_events();
  return rig;
}

struct ChangeCase {
  const char* what;
  Command command;
  std::function<void(State&)> change;
};

// Every command without a reply: the state differs only by the expected change.
TEST(Execute, EachCommandChangesOnlyItsOwnMembers) {
  const int f = rhino()->index_of('F');
  const int e = rhino()->index_of('E');
  const int d = rhino()->index_of('D');
  const int a = rhino()->index_of('A');
  const ChangeCase cases[] = {
      {"F+7", Move{'F', 7}, [=](State& s) { s.motor(f).error = 7; }},
      {"F+0", Move{'F', 0}, [](State&) {}},
      {"E+3", Move{'E', 3},
       [=](State& s) { s.motor(e).error = static_cast<std::int8_t>(s.motor(e).error + 3); }},
      {"F200S", SetSpeed{'F', 200}, [=](State& s) { s.motor(f).speed = 200; }},
      {"EX", Stop{'E'},
       [=](State& s) {
         s.motor(e).error = 0;
         s.motor(e).phase = 0;
       }},
      {"L", SetAuxiliary{1, true}, [](State&) {}},
      {"M", SetAuxiliary{1, false}, [](State& s) { s.io.auxiliary = 0; }},
      {"N", SetAuxiliary{2, true}, [](State& s) { s.io.auxiliary = 3; }},
      {"P1", SetOutput{1, true}, [](State& s) { s.io.outputs = 0x85; }},
      {"R8", SetOutput{8, false}, [](State& s) { s.io.outputs = 0x04; }},
      {"A#", ToggleDisplay{}, [](State& s) { s.display.on = false; }},
      {"A!-9,0,9!", SetViewVector{-9, 0, 9},
       [](State& s) {
         s.display.view = {-9, 0, 9};
       }},
      {"A.255", SetRefreshPeriod{255}, [](State& s) { s.display.period_half_s = 255; }},
      {"A|", ToggleErasing{},
       [](State& s) {
         s.display.erase = true;
         s.tip_path = {};
       }},
      {"A%6", SelectStatus{6}, [](State& s) { s.display.status_option = 6; }},
      {"Alt F6", ToggleFunctionKeys{}, [](State& s) { s.display.function_keys = true; }},
      {"A@", ToggleSimulator{}, [](State& s) { s.enabled = false; }},
      {"Q", ControllerReset{},
       [=](State& s) {
         for (const int i : {e, d, a}) s.motor(i).error = s.motor(i).phase = 0;
         s.motor(e).speed = 110;
         s.motor(a).speed = 60;
         s.io.outputs = s.io.auxiliary = 0;
       }},
      {"A$", SoftHome{},
       [=](State& s) {
         for (const int i : {e, d, a}) s.motor(i).error = s.motor(i).phase = 0;
         for (const int i : {e, d, a}) s.motor(i).count = 0;
       }},
  };
  for (const ChangeCase& wanted : cases) {
    Rig rig = busy_rig();
    State state = rig.state();
    wanted.change(state);
    EXPECT_EQ(rig.execute(wanted.command), Reply(NoReply{})) << wanted.what;
    EXPECT_EQ(rig.state(), state) << wanted.what;
  }
}

struct AnswerCase {
  const char* what;
  Command command;
  Reply reply;
};

// After 300 ticks E has 27 of its 50 counts to go, D 12 of its -60, A 3 of its -5.
TEST(Execute, InquiriesChangeNothing) {
  const AnswerCase cases[] = {
      {"E?", QueryError{'E'}, ErrorMagnitude{27}},
      {"D?", QueryError{'D'}, ErrorMagnitude{12}},
      {"F?", QueryError{'F'}, ErrorMagnitude{0}},
      {"ET", QuerySignedError{'E'}, SignedError{27}},
      {"DT", QuerySignedError{'D'}, SignedError{-12}},
      {"FT", QuerySignedError{'F'}, SignedError{0}},
      {"EV", QuerySwitch{'E'}, SwitchState{false}},
      {"DV", QuerySwitch{'D'}, SwitchState{false}},
      {"I", QuerySwitchesI{}, SwitchBits{0, 15, 0, 'I'}},
      {"J", QuerySwitchesJ{}, SwitchBits{0, 48, 0, 'J'}},
      {"K", QueryInputs{}, SwitchBits{0, 0, 2, 'K'}},
  };
  for (const AnswerCase& wanted : cases) {
    Rig rig = busy_rig();
    const State before = rig.state();
    EXPECT_EQ(rig.execute(wanted.command), wanted.reply) << wanted.what;
    EXPECT_EQ(rig.state(), before) << wanted.what;
    EXPECT_TRUE(rig.simulation.events().empty()) << wanted.what;
  }
}

TEST(Execute, ReportsAClosedSwitch) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'E', -40}});
  EXPECT_EQ(rig.execute(QuerySwitch{'E'}), Reply(SwitchState{true}));
  EXPECT_EQ(rig.execute(QuerySwitchesI{}), Reply(SwitchBits{4, 15, 0, 'I'}));
}

TEST(Execute, TheLargestErrorIs128) {
  Rig rig(roomy_rhino());
  rig.move('E', -128);
  EXPECT_EQ(rig.execute(QueryError{'E'}), Reply(ErrorMagnitude{128}));
  EXPECT_EQ(rig.execute(QuerySignedError{'E'}), Reply(SignedError{-128}));
}

TEST(Execute, LettersWithoutAJointAnswerAsAJointAtRest) {
  for (const char label : {'G', 'H'}) {
    const AnswerCase cases[] = {
        {"move", Move{label, 100}, NoReply{}},
        {"speed", SetSpeed{label, 100}, NoReply{}},
        {"stop", Stop{label}, NoReply{}},
        {"?", QueryError{label}, ErrorMagnitude{0}},
        {"T", QuerySignedError{label}, SignedError{0}},
        {"V", QuerySwitch{label}, SwitchState{false}},
    };
    for (const AnswerCase& wanted : cases) {
      Rig rig = busy_rig();
      const State before = rig.state();
      EXPECT_EQ(rig.execute(wanted.command), wanted.reply) << label << " " << wanted.what;
      EXPECT_EQ(rig.state(), before) << label << " " << wanted.what;
      EXPECT_EQ(rig.events_of<Warning>(),
                (std::vector<Warning>{{WarningCode::kNoSuchJoint, label, 0, 0, {}}}))
          << label << " " << wanted.what;
    }
  }
}

struct EventCase {
  const char* what;
  Command command;
  std::vector<EventBody> events;
};

TEST(Execute, ReportsEvents) {
  const EventCase cases[] = {
      {"a move", Move{'F', 7}, {MoveTaken{'F', 7, 7}}},
      {"a move on top", Move{'E', 3}, {MoveTaken{'E', 3, 30}}},
      {"a wrap",
       Move{'E', 120},
       {MoveTaken{'E', 120, -109}, Warning{WarningCode::kCounterOverflow, 'E', 120, -109, {}}}},
      {"an output", SetOutput{1, true}, {OutputChanged{1, true}}},
      {"the same output", SetOutput{3, true}, {}},
      {"a port", SetAuxiliary{1, false}, {AuxiliaryChanged{1, false}}},
      {"the same port", SetAuxiliary{2, false}, {}},
      {"disabling", ToggleSimulator{}, {EnabledChanged{false}}},
      {"home", SoftHome{}, {Homed{}}},
      {"reset",
       ControllerReset{},
       {OutputChanged{3, false}, OutputChanged{8, false}, AuxiliaryChanged{1, false}}},
      {"a stop", Stop{'E'}, {}},
  };
  for (const EventCase& wanted : cases) {
    Rig rig = busy_rig();
    rig.execute(wanted.command);
    std::vector<EventBody> events;
    for (const Event& event : rig.simulation.take_events()) {
      EXPECT_EQ(event.tick, 300) << wanted.what;
      events.push_back(event.body);
    }
    EXPECT_EQ(events, wanted.events) << wanted.what;
  }
}

TEST(Execute, TwoTogglesEnableTheSimulator) {
  Rig rig;
  rig.execute(ToggleSimulator{});
  EXPECT_FALSE(rig.state().enabled);
  rig.execute(ToggleSimulator{});
  EXPECT_TRUE(rig.state().enabled);
}

TEST(Execute, MotorsContinueWhileDisabled) {
  Rig rig(roomy_rhino());
  rig.move('E', 11);
  rig.execute(ToggleSimulator{});
  rig.pass(1000);
  EXPECT_EQ(rig.count('E'), 11);
}

TEST(Execute, SoftHomeOpensSwitchesAndFreesBlockedMotors) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'F', 771}, {'E', -50}});
  rig.move('F', 5);
  ASSERT_EQ(rig.motor('F').blocked, Blocked::kLimit);
  ASSERT_TRUE(rig.motor('E').switch_closed);
  rig.execute(SoftHome{});
  EXPECT_EQ(rig.state().motors, initial_state(rig.model()).motors);
  EXPECT_EQ(rig.events_of<SwitchChanged>(),
            (std::vector<SwitchChanged>{{'F', false, 0}, {'E', false, 0}}));
}

TEST(Execute, WithoutACameraInquiriesHaveNoAnswer) {
  for (const Command& command :
       {Command{CameraImage{}}, Command{CameraRow{0}}, Command{CameraPixel{0, 0}}}) {
    Rig rig;
    EXPECT_EQ(rig.execute(command), Reply(NoReply{}));
    EXPECT_EQ(rig.events_of<Warning>().at(0).code, WarningCode::kBadCameraArgument);
  }
}

TEST(Execute, ReportsEachChangeOfAnInputLine) {
  Rig rig;
  rig.simulation.set_input(5, true);
  rig.simulation.set_input(5, true);
  rig.simulation.set_input(8, true);
  rig.simulation.set_input(5, false);
  EXPECT_EQ(rig.state().io.inputs, 0x80);
  EXPECT_EQ(rig.events_of<InputChanged>(),
            (std::vector<InputChanged>{{5, true}, {8, true}, {5, false}}));
}

TEST(Execute, TheInitialStateIsThatOfThePaper) {
  const Rig rig;
  const State& state = rig.state();
  EXPECT_EQ(state.tick, 0);
  EXPECT_TRUE(state.enabled);
  EXPECT_EQ(state.display, (DisplaySettings{false, {1, 1, 1}, 6, true, 0, true}));
  EXPECT_EQ(state.io, InputOutput{});
  EXPECT_EQ(state.stall, Stall::kNo);
  const std::pair<char, int> speeds[] = {{'F', 110}, {'E', 110}, {'D', 160},
                                         {'C', 160}, {'B', 110}, {'A', 60}};
  for (const auto& [label, speed] : speeds) {
    EXPECT_EQ(rig.motor(label).speed, speed) << label;
    EXPECT_EQ(rig.count(label), 0) << label;
    EXPECT_EQ(rig.error(label), 0) << label;
  }
}

}  // namespace
}  // namespace xr3
