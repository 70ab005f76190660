// Faults in a cell: the calls, the lines, and what belongs to the state.
#include <gtest/gtest.h>

#include "cell/cell.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"

namespace xr3 {
namespace {

Fault fault_named(std::string name, FaultKind kind) {
  Fault fault;
  fault.name = std::move(name);
  fault.kind = kind;
  fault.from_tick = 0;
  return fault;
}

/// A cell in memory with two lines, 1 and 2.
struct Faulty {
  explicit Faulty(std::vector<Fault> faults = {})
      : cell("main", test::rhino(), SimClock::manual()) {
    cell.set_faults({7, std::move(faults)});
    for (int i = 0; i < 2; ++i) cell.apply(LineOpened{"test"}, 0);
  }

  std::vector<CellEvent> events;
  Cell cell;
  test::OnEvent on_event{cell, [this](const CellEvent& each) { events.push_back(each); }};

  std::string send(LineId line, std::string_view bytes) {
    cell.apply(BytesIn{line, bytes}, 0);
    std::string reply(cell.find_line(line)->outbox());
    cell.sent({line, reply.size()});
    return reply;
  }
  call::Outcome call(call::Call call) { return cell.apply(Input{std::move(call)}, 0).outcome; }
  void step(Tick ticks) { call(call::Step{ticks}); }

  struct News {
    std::optional<LineId> line;
    FaultNews news;
  };
  std::vector<News> news() const {
    std::vector<News> found;
    for (const CellEvent& event : events) {
      const auto* body = std::get_if<EventBody>(&event.note);
      const auto* fault = body != nullptr ? std::get_if<FaultNews>(body) : nullptr;
      if (fault != nullptr) found.push_back({event.line, *fault});
    }
    return found;
  }
};

TEST(CellFaults, ActOnTheirLineAndAreEventsOfIt) {
  Fault fault = fault_named("deaf", FaultKind::kByteDropped);
  fault.line = 2;
  fault.after_bytes = 1;
  fault.from_tick.reset();
  Faulty faulty({fault});
  EXPECT_EQ(faulty.send(1, "E?E?"), "  ");
  EXPECT_EQ(faulty.send(2, "E?E?"), " ") << "the first ? was lost";
  ASSERT_EQ(faulty.news().size(), 1U);
  EXPECT_EQ(faulty.news()[0].line, 2U);
  EXPECT_EQ(faulty.news()[0].news.at, 1);
  EXPECT_EQ(faulty.send(2, "?"), " ") << "once";
}

TEST(CellFaults, OffsetsCountDataBytesWithoutTelnet) {
  Fault fault = fault_named("deaf", FaultKind::kByteDropped);
  fault.after_bytes = 1;
  fault.from_tick.reset();
  Faulty faulty({fault});
  const std::string reply = faulty.send(1,
                                        "\xff\xfd\x03"
                                        "E?D?");
  EXPECT_EQ(reply, "\xff\xfb\x03 ");
}

TEST(CellFaults, DoNotConcernTheMonitor) {
  Faulty faulty({fault_named("deaf", FaultKind::kByteDropped)});
  const LineId monitor = faulty.cell.apply(LineOpened{"monitor", LineKind::kMonitor}, 0).line;
  EXPECT_EQ(faulty.send(monitor, "E?"), " ");
  EXPECT_EQ(faulty.send(1, "E?"), "");
}

TEST(CellFaults, APowerCycleForgetsTheBeginningOfACommand) {
  Fault fault = fault_named("brownout", FaultKind::kPowerCycle);
  fault.from_tick.reset();
  fault.at_tick = 10;
  Faulty faulty({fault});
  faulty.send(1, "E+5");
  faulty.step(10);
  faulty.send(1, "\r");
  EXPECT_EQ(faulty.send(2, "E?"), " ");
}

TEST(CellFaults, ALostReplyIsNotInTheOutput) {
  Faulty faulty({fault_named("mute", FaultKind::kReplyLost)});
  EXPECT_EQ(faulty.send(1, "E?"), "");
  EXPECT_EQ(faulty.cell.find_line(1)->output_end(), 0U);
  EXPECT_EQ(faulty.cell.counters().bytes_out, 0U);
}

TEST(CellFaults, ALineThatIsCutTakesNoMoreBytes) {
  Fault fault = fault_named("cut", FaultKind::kLineDisconnected);
  fault.from_tick.reset();
  fault.after_bytes = 3;
  Faulty faulty({fault});
  EXPECT_EQ(faulty.cell.apply(BytesIn{1, "E?D?C?"}, 0).bytes_taken, 4U);
  EXPECT_TRUE(faulty.cell.find_line(1)->is_cut());
  EXPECT_EQ(faulty.cell.find_line(1)->outbox(), "  ");
  EXPECT_FALSE(faulty.cell.find_line(2)->is_cut());
}

TEST(CellFaults, WithAByteClockTheCommandThatIsCutDoesNotAct) {
  Fault fault = fault_named("cut", FaultKind::kLineDisconnected);
  fault.from_tick.reset();
  fault.after_bytes = 3;
  for (const bool is_paused : {false, true}) {
    Cell cell("main", test::rhino(), SimClock::bytes());
    cell.set_byte_clock({});
    cell.set_faults({7, {fault}});
    cell.apply(LineOpened{"test"}, 0);
    if (is_paused) cell.apply(Input{call::Call{call::Pause{}}}, 0);
    cell.apply(BytesIn{1, "E?D?C?"}, 0);
    EXPECT_TRUE(cell.find_line(1)->is_cut());
    EXPECT_EQ(cell.find_line(1)->outbox(), " ") << (is_paused ? "paused" : "running");
  }
}

TEST(CellFaults, ACutAtATickWakesTheLines) {
  Fault fault = fault_named("cut", FaultKind::kLineDisconnected);
  fault.from_tick.reset();
  fault.at_tick = 50;
  fault.line = 2;
  Faulty faulty({fault});
  faulty.step(49);
  EXPECT_TRUE(faulty.cell.take_woken_lines().empty());
  faulty.step(1);
  EXPECT_EQ(faulty.cell.take_woken_lines(), (std::vector<LineId>{2}));
  EXPECT_FALSE(faulty.cell.find_line(1)->is_cut());
  EXPECT_TRUE(faulty.cell.find_line(2)->is_cut());
}

// --- Replies that wait.

/// The replies that have left on line 1.
std::string left_on(Faulty& faulty) { return faulty.send(1, ""); }

TEST(CellFaults, ADelayedReplyLeavesLaterAndThoseBehindItWait) {
  Fault fault = fault_named("slow", FaultKind::kReplyDelayed);
  fault.delay_ms = 40;
  fault.count = 1;
  Faulty faulty({fault});
  EXPECT_EQ(faulty.send(1, "E+5\rE?D?"), "");
  EXPECT_EQ(faulty.send(2, "D?"), " ");
  EXPECT_EQ(next_due(faulty.cell.value()), 40);
  EXPECT_FALSE(faulty.cell.is_at_rest());
  faulty.step(39);
  EXPECT_EQ(left_on(faulty), "");
  faulty.step(1);
  EXPECT_EQ(left_on(faulty), "% ") << "as it was when it was asked for";
  EXPECT_EQ(faulty.cell.take_woken_lines(), (std::vector<LineId>{1}));
  EXPECT_EQ(faulty.send(1, "D?"), " ") << "nothing waits any more";
}

TEST(CellFaults, ALineEndsAfterItsDelayedReplies) {
  Fault fault = fault_named("slow", FaultKind::kReplyDelayed);
  fault.delay_ms = 40;
  Faulty faulty({fault});
  faulty.send(1, "E?");
  faulty.cell.apply(InputEnded{1}, 0);
  EXPECT_FALSE(faulty.cell.find_line(1)->is_drained());
  faulty.call(call::RunUntil{std::nullopt, 1000});
  EXPECT_EQ(faulty.cell.state().tick, 40) << "idle is when it has left";
  EXPECT_TRUE(faulty.cell.find_line(1)->is_drained());
  EXPECT_EQ(left_on(faulty), " ");
}

TEST(CellFaults, BatchedRepliesLeaveTogether) {
  Faulty faulty({fault_named("usb", FaultKind::kReplyBatched)});
  EXPECT_EQ(faulty.send(1, "E?"), " ") << "tick 0 is a multiple of 16";
  faulty.step(3);
  EXPECT_EQ(faulty.send(1, "E?"), "");
  faulty.step(7);
  EXPECT_EQ(faulty.send(1, "D?"), "");
  faulty.step(5);
  EXPECT_EQ(left_on(faulty), "");
  faulty.step(1);
  EXPECT_EQ(left_on(faulty), "  ");
}

TEST(CellFaults, XoffHoldsRepliesUntilItEnds) {
  Fault fault = fault_named("xoff", FaultKind::kXoffStall);
  fault.from_tick = 10;
  fault.ticks = 100;
  Faulty faulty({fault});
  EXPECT_EQ(faulty.send(1, "E?"), " ");
  faulty.step(50);
  EXPECT_EQ(faulty.send(1, "E?D?"), "");
  EXPECT_EQ(next_due(faulty.cell.value()), 110);
  faulty.step(59);
  EXPECT_EQ(left_on(faulty), "");
  faulty.step(1);
  EXPECT_EQ(left_on(faulty), "  ");
}

TEST(CellFaults, XoffWithoutAnEndEndsWhenItIsCleared) {
  Faulty faulty({fault_named("xoff", FaultKind::kXoffStall)});
  EXPECT_EQ(faulty.send(1, "E?"), "");
  EXPECT_EQ(next_due(faulty.cell.value()), std::nullopt);
  faulty.step(100'000);
  EXPECT_EQ(left_on(faulty), "");
  faulty.call(call::ClearFault{"xoff"});
  faulty.step(0);
  EXPECT_EQ(left_on(faulty), " ");
}

TEST(CellFaults, AnEndAfterTheEndOfTimeIsNone) {
  Fault fault = fault_named("xoff", FaultKind::kXoffStall);
  fault.from_tick = 5;
  fault.ticks = Fault::kMaxTicks;
  Faulty faulty({fault});
  faulty.step(10);
  EXPECT_EQ(faulty.send(1, "E?"), "");
  EXPECT_EQ(next_due(faulty.cell.value()), std::nullopt);
  EXPECT_EQ(next_wake(faulty.cell.value()), 10 + kMaxSleep);
}

TEST(CellFaults, ALineWithoutAnEndOfXoffDoesNotWaitForIt) {
  Faulty faulty({fault_named("xoff", FaultKind::kXoffStall)});
  faulty.send(1, "E?");
  faulty.cell.apply(InputEnded{1}, 0);
  EXPECT_TRUE(faulty.cell.find_line(1)->is_drained());
}

TEST(CellFaults, RepliesThatWaitAreBounded) {
  Faulty faulty({fault_named("xoff", FaultKind::kXoffStall)});
  const std::string flood = "E" + std::string(5000, '?');
  EXPECT_EQ(faulty.cell.apply(BytesIn{1, flood}, 0).bytes_taken, LineFaults::kMaxReplies + 1);
  EXPECT_LT(faulty.cell.find_line(1)->held_bytes(), std::size_t{512} * 1024);
  faulty.call(call::ClearFault{"xoff"});
  faulty.step(0);
  EXPECT_EQ(left_on(faulty).size(), LineFaults::kMaxReplies);
  EXPECT_EQ(faulty.cell.apply(BytesIn{1, "?"}, 0).bytes_taken, 1U);
}

TEST(CellFaults, AtALineSpeedADelayedReplyTakesItsTimeAfterwards) {
  Fault fault = fault_named("slow", FaultKind::kReplyDelayed);
  fault.delay_ms = 100;
  Cell cell("main", test::rhino(), SimClock::manual());
  cell.set_line_speed({*parse_serial_settings("9600-7e2"), {}});
  cell.set_faults({7, {fault}});
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E?"}, 0);
  cell.apply(Input{call::Call{call::Step{103}}}, 0);
  EXPECT_EQ(cell.find_line(1)->outbox(), "") << "3 ms for two bytes, then 100 ms";
  cell.apply(Input{call::Call{call::Step{2}}}, 0);
  EXPECT_EQ(cell.find_line(1)->outbox(), " ") << "and 2 ms for the reply";
}

TEST(CellFaults, AtALineSpeedACutLineForgetsTheBytesUnderWay) {
  Fault fault = fault_named("cut", FaultKind::kLineDisconnected);
  fault.from_tick.reset();
  fault.at_tick = 5;
  Cell cell("main", test::rhino(), SimClock::manual());
  cell.set_line_speed({*parse_serial_settings("9600-7e2"), {}});
  cell.set_faults({7, {fault}});
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E?D?C?E+5\r"}, 0);
  cell.apply(Input{call::Call{call::Step{200}}}, 0);
  EXPECT_TRUE(cell.find_line(1)->is_cut());
  EXPECT_TRUE(cell.find_line(1)->is_drained());
  EXPECT_EQ(cell.find_line(1)->outbox(), " ") << "D? would have acted in tick 5";
  EXPECT_EQ(cell.state().tick, 200);
}

TEST(CellFaults, WakeTheServerAtTheirTicks) {
  Fault fault = fault_named("jam", FaultKind::kMotorStuck);
  fault.joint = 'E';
  fault.from_tick = 5000;
  fault.ticks = 100'000'000;
  Faulty faulty({fault});
  EXPECT_EQ(next_wake(faulty.cell.value()), 5000);
  faulty.step(5000);
  EXPECT_EQ(next_wake(faulty.cell.value()), 5000 + kMaxSleep);
  faulty.call(call::ClearFault{});
  EXPECT_EQ(next_wake(faulty.cell.value()), std::nullopt);
}

TEST(CellFaults, AResetReturnsToThoseOfTheStart) {
  Faulty faulty({fault_named("mute", FaultKind::kReplyLost)});
  faulty.send(1, "E?");
  const State before = faulty.cell.state();
  faulty.call(call::ClearFault{});
  EXPECT_EQ(faulty.send(1, "E?"), " ");
  faulty.call(call::Reset{});
  EXPECT_EQ(faulty.cell.state().faults.all.size(), 1U);
  EXPECT_EQ(faulty.cell.state().faults.all[0].effects, 0U);
  EXPECT_EQ(faulty.send(1, "E?"), "");
  EXPECT_EQ(faulty.cell.state(), before);
}

TEST(CellFaults, ASnapshotHasThem) {
  Faulty faulty;
  Fault fault = fault_named("slip", FaultKind::kEncoderSlip);
  fault.joint = 'E';
  faulty.call(call::SetFault{fault, 9});
  faulty.call(call::SaveSnapshot{"a"});
  const State saved = faulty.cell.state();
  faulty.call(call::ClearFault{"slip"});
  EXPECT_NE(faulty.cell.state(), saved);
  faulty.call(call::LoadSnapshot{"a", nullptr});
  EXPECT_EQ(faulty.cell.state(), saved);
  EXPECT_EQ(faulty.cell.state().faults.seed, 9U);
}

std::string code_of_refusal(const call::Outcome& outcome) {
  const auto* refused = std::get_if<call::Refused>(&outcome);
  return refused != nullptr ? refused->code : "";
}

TEST(CellFaults, CallsThatMakeNoSenseAreRefused) {
  Faulty faulty;
  Fault fault = fault_named("jam", FaultKind::kMotorStuck);
  fault.joint = 'H';
  EXPECT_EQ(code_of_refusal(faulty.call(call::SetFault{fault, {}})), "no_such_joint");
  EXPECT_EQ(code_of_refusal(faulty.call(call::ClearFault{"jam"})), "no_such_fault");
  EXPECT_EQ(code_of_refusal(faulty.call(call::ClearFault{})), "");
  for (std::size_t i = 0; i < kMaxFaults; ++i) {
    const Fault each = fault_named("f" + std::to_string(i), FaultKind::kReplyLost);
    EXPECT_EQ(code_of_refusal(faulty.call(call::SetFault{each, {}})), "");
  }
  EXPECT_EQ(
      code_of_refusal(faulty.call(call::SetFault{fault_named("more", FaultKind::kReplyLost), {}})),
      "limit");
  EXPECT_EQ(
      code_of_refusal(faulty.call(call::SetFault{fault_named("f0", FaultKind::kReplyLost), {}})),
      "");
}

TEST(CellFaults, TheSameFaultsAndBytesGiveTheSameRun) {
  const auto run = [](bool is_cut_up) {
    Fault noise = fault_named("noise", FaultKind::kByteFlipped);
    noise.chance = kCertain / 10;
    Fault slip = fault_named("slip", FaultKind::kEncoderSlip);
    slip.joint = 'E';
    slip.chance = kCertain / 20;
    Faulty faulty({noise, slip});
    std::string replies;
    for (int i = 0; i < 40; ++i) {
      const std::string bytes = "E+5\rE?D-3\rD?F+2\rF?I";
      if (is_cut_up) {
        for (const char byte : bytes) replies += faulty.send(1, {&byte, 1});
      } else {
        replies += faulty.send(1, bytes);
      }
      for (int part = 0; part < 50; part += is_cut_up ? 1 : 50) faulty.step(is_cut_up ? 1 : 50);
    }
    return std::pair(replies, faulty.cell.state());
  };
  EXPECT_EQ(run(true), run(false));
}

}  // namespace
}  // namespace xr3
