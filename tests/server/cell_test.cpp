#include "server/cell.hpp"

#include <gtest/gtest.h>

#include <new>

#include "server/failure.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

/// A whole cell in memory, with everything that it told.
struct Lab {
  explicit Lab(SimClock clock = SimClock::manual(), Profile profile = Profile::kPaper)
      : cell("main", test::rhino(profile), clock,
             [this](const CellEvent& e, const Model&) { told.push_back(e); }) {}

  std::vector<CellEvent> told;
  Cell cell;

  void open(LineId line, WallNs now = 0) {
    EXPECT_EQ(cell.apply(LineOpened{"test"}, now).line, line);
  }
  /// Sends bytes and returns the reply.
  std::string send(LineId line, std::string_view bytes, WallNs now = 0) {
    cell.apply(BytesIn{line, bytes}, now);
    Line& of_cell = *cell.find_line(line);
    const std::string reply(of_cell.outbox());
    of_cell.sent(reply.size());
    return reply;
  }
  call::Outcome call(call::Call call, WallNs now = 0) {
    return cell.apply(Input{call}, now).outcome;
  }
  Counts count(char label) const { return cell.state().motor(cell.model().index_of(label)).count; }

  template <class Note>
  std::vector<Note> notes() const {
    std::vector<Note> found;
    for (const CellEvent& event : told) {
      if (const Note* note = std::get_if<Note>(&event.note)) found.push_back(*note);
    }
    return found;
  }
};

TEST(Cell, InStandingTimeNothingMovesUntilItIsStepped) {
  Lab lab;
  lab.open(1);
  lab.send(1, "E+5\r", 1'000'000 * kMs);
  EXPECT_EQ(lab.send(1, "E?", 2'000'000 * kMs), "%");
  lab.call(call::Step{1000});
  EXPECT_EQ(lab.send(1, "E?"), " ");
  EXPECT_EQ(lab.count('E'), 5);
}

TEST(Cell, RealTimeMovesWithTheWallClockAndItsRate) {
  Lab lab(SimClock::real(Rate{2'000'000}, 100 * kMs));
  lab.open(1, 100 * kMs);
  lab.send(1, "E+50\r", 100 * kMs);
  lab.cell.catch_up(150 * kMs);
  EXPECT_EQ(lab.cell.state().tick, 100);
  EXPECT_EQ(lab.count('E'), 11);  // 100 ticks at 110 counts a second
}

TEST(Cell, RunningTimeEndsWhereItsTicksWouldBeTooLargeToSay) {
  constexpr Tick kLast = (Tick{1} << 53) - 1;
  Lab lab;
  lab.call(call::RunUntil{kLast - 10, kLast});
  lab.call(call::Resume{});
  lab.cell.catch_up(7 * kMs);
  EXPECT_EQ(lab.cell.state().tick, kLast - 3);
  lab.cell.catch_up(1'000'000 * kMs);
  EXPECT_EQ(lab.cell.state().tick, kLast);
}

TEST(Cell, AReplyGoesOnlyToTheLineThatAsked) {
  Lab lab;
  lab.open(1);
  lab.open(2);
  lab.send(1, "E+7\r");
  EXPECT_EQ(lab.send(2, "E?"), "'");
  EXPECT_EQ(lab.cell.find_line(1)->outbox(), "");
}

TEST(Cell, StepAndRunUntilNeedStandingTime) {
  Lab lab(SimClock::real(Rate{}, 0));
  EXPECT_EQ(std::get<call::Refused>(lab.call(call::Step{1})).code, "clock_running");
  EXPECT_EQ(std::get<call::Refused>(lab.call(call::RunUntil{{}, 1})).code, "clock_running");
  lab.call(call::Pause{}, 10 * kMs);
  EXPECT_TRUE(std::holds_alternative<call::Done>(lab.call(call::Step{5}, 50 * kMs)));
  EXPECT_EQ(lab.cell.state().tick, 15);
  lab.call(call::Resume{}, 60 * kMs);
  lab.cell.catch_up(70 * kMs);
  EXPECT_EQ(lab.cell.state().tick, 25);
}

TEST(Cell, RunUntilIdleStopsAtTheTickOfTheLastCount) {
  Lab lab;
  lab.open(1);
  lab.send(1, "F+10\r");
  const auto outcome = std::get<call::Done>(lab.call(call::RunUntil{{}, 60'000}));
  EXPECT_EQ(outcome.reached, true);
  EXPECT_EQ(outcome.ran_ticks, 91);  // ceil(10 * 1000 / 110)
  EXPECT_EQ(lab.count('F'), 10);
}

TEST(Cell, RunUntilSaysWhenItWasNotEnough) {
  Lab lab;
  lab.open(1);
  lab.send(1, "F+10\r");
  const auto outcome = std::get<call::Done>(lab.call(call::RunUntil{{}, 20}));
  EXPECT_EQ(outcome.reached, false);
  EXPECT_EQ(outcome.ran_ticks, 20);
  EXPECT_EQ(std::get<call::Done>(lab.call(call::RunUntil{Tick{50}, 1000})).reached, true);
  EXPECT_EQ(lab.cell.state().tick, 50);
}

TEST(Cell, ResetBeginsAnEpochAndEmptiesTheParsers) {
  Lab lab;
  lab.open(1);
  lab.send(1, "E+5\rL");
  lab.call(call::Step{1000});
  lab.send(1, "E+9");
  lab.call(call::Reset{});
  EXPECT_EQ(lab.cell.epoch(), 1);
  EXPECT_EQ(lab.cell.state(), initial_state(lab.cell.model()));
  lab.send(1, "\r?");
  EXPECT_EQ(lab.send(1, "E?"), " ");
  EXPECT_EQ(lab.notes<EpochNote>().at(0).from_tick, 1000);
}

TEST(Cell, HomeFreesAStalledRobot) {
  Lab lab;
  lab.open(1);
  for (const char* bytes : {"E-120\r", "D+120\r"}) {
    for (int i = 0; i < 8; ++i) {
      lab.send(1, bytes);
      lab.call(call::RunUntil{{}, 100'000});
    }
  }
  ASSERT_EQ(lab.cell.state().stall, Stall::kProtectedRegion);
  lab.call(call::Home{});
  EXPECT_EQ(lab.cell.state().stall, Stall::kNo);
  EXPECT_EQ(lab.count('E'), 0);
}

TEST(Cell, ProblemsAreToldWithOffsetBytesAndReason) {
  Lab lab;
  lab.open(1);
  lab.send(1, "E+5\rE+200\r");
  const auto problems = lab.notes<ProblemNote>();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "number_out_of_range");
  EXPECT_EQ(problems[0].offset, 4U);
  EXPECT_EQ(problems[0].raw.view(), "E+200\r");
  EXPECT_EQ(problems[0].message, "E+200: a move is -128...127 counts; not obeyed");
}

TEST(Cell, ALineOpenedWhileDisabledIsToldSo) {
  Lab lab;
  lab.open(1);
  lab.send(1, "A@");
  lab.open(2);
  ASSERT_EQ(lab.notes<ProblemNote>().size(), 1U);
  EXPECT_EQ(lab.notes<ProblemNote>()[0].code, "disabled");
  EXPECT_EQ(lab.send(2, "E?"), "");
  EXPECT_EQ(lab.send(2, "A@E?"), " ");
}

TEST(Cell, ALineThatIsGoneTakesNothing) {
  Lab lab;
  lab.open(1);
  lab.cell.apply(LineClosed{1, CloseReason::kClientClosed}, 0);
  EXPECT_EQ(lab.cell.apply(BytesIn{1, "E+5\r"}, 0).bytes_taken, 0U);
  EXPECT_EQ(lab.cell.lines().size(), 0U);
  EXPECT_EQ(lab.notes<LineClosedNote>().size(), 1U);
}

TEST(Cell, EventsComeInOrderOfTheirTicks) {
  Lab lab(SimClock::real(Rate{}, 0));
  lab.open(1);
  lab.send(1, "E+3\rD+3\r");
  lab.cell.catch_up(1000 * kMs);
  for (std::size_t i = 1; i < lab.told.size(); ++i)
    EXPECT_LE(lab.told[i - 1].tick, lab.told[i].tick);
  EXPECT_EQ(lab.told.back().line, std::nullopt);
}

// --- Failures.

TEST(Cell, AnExceptionOutOfTheDoorIsVital) {
  Cell cell("main", test::rhino(), SimClock::manual(),
            [](const CellEvent&, const Model&) { throw std::bad_alloc(); });
  try {
    cell.apply(LineOpened{"test"}, 0);
    ADD_FAILURE() << "the sink has thrown";
  } catch (const VitalFailure& failure) {
    EXPECT_STREQ(failure.what(), "the cell: std::bad_alloc");
  }
}

TEST(Cell, AFrozenCellTakesNothing) {
  Lab lab(SimClock::real(Rate{1'000'000}, 0));
  lab.open(1);
  const State before = lab.cell.state();
  const std::size_t told = lab.told.size();
  lab.cell.freeze();
  lab.cell.apply(BytesIn{1, "E+5\rE?"}, 5 * kMs);
  lab.cell.apply(LineClosed{1}, 5 * kMs);
  lab.cell.catch_up(10 * kMs);
  EXPECT_EQ(lab.cell.state(), before);
  EXPECT_EQ(lab.told.size(), told);
}

}  // namespace
}  // namespace xr3
