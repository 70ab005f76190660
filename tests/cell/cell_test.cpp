#include "cell/cell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <new>

#include "cell/failure.hpp"
#include "core/camera.hpp"
#include "core/kinematics.hpp"
#include "protocol/files/workcell.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

/// A cell in memory that collects its events.
struct Lab {
  explicit Lab(SimClock clock = SimClock::manual(), Profile profile = Profile::kPaper)
      : cell("main", test::rhino(profile), clock) {}

  std::vector<CellEvent> events;
  Cell cell;
  test::OnEvent on_event{cell, [this](const CellEvent& each) { events.push_back(each); }};

  void open(LineId line, WallNs now = 0) {
    EXPECT_EQ(cell.apply(LineOpened{"test"}, now).line, line);
  }
  /// Sends bytes and returns the reply.
  std::string send(LineId line, std::string_view bytes, WallNs now = 0) {
    cell.apply(BytesIn{line, bytes}, now);
    const std::string reply(cell.find_line(line)->outbox());
    cell.sent({line, reply.size()});
    return reply;
  }
  call::Outcome call(call::Call call, WallNs now = 0) {
    return cell.apply(Input{call}, now).outcome;
  }
  Counts count(char label) const { return cell.state().motor(cell.model().index_of(label)).count; }

  template <class Note>
  std::vector<Note> notes() const {
    std::vector<Note> found;
    for (const CellEvent& event : events) {
      if (const Note* note = std::get_if<Note>(&event.note)) found.push_back(*note);
    }
    return found;
  }
};

TEST(Cell, EventsAreCopiedInPieces) {
  Lab lab;
  std::vector<CellEvent> copies;
  const std::int64_t first = lab.cell.events().next();
  for (int i = 0; i < 5; ++i) lab.call(call::Reset{});
  EXPECT_EQ(lab.cell.copy_events(first, 2, copies), first + 2);
  EXPECT_EQ(lab.cell.copy_events(first + 2, 100, copies), lab.cell.events().next());
  ASSERT_EQ(copies.size(), lab.events.size());
  for (std::size_t i = 0; i < copies.size(); ++i) EXPECT_EQ(copies[i].epoch, lab.events[i].epoch);

  for (std::size_t i = 0; i < Cell::kMaxEvents; ++i) lab.call(call::Reset{});
  copies.clear();
  EXPECT_EQ(lab.cell.copy_events(first, 1, copies), lab.cell.events().first() + 1)
      << "the ring has dropped those before";
}

TEST(Cell, WithAManualClockNothingMovesUntilAStep) {
  Lab lab;
  lab.open(1);
  lab.send(1, "E+5\r", 1'000'000 * kMs);
  EXPECT_EQ(lab.send(1, "E?", 2'000'000 * kMs), "%");
  lab.call(call::Step{1000});
  EXPECT_EQ(lab.send(1, "E?"), " ");
  EXPECT_EQ(lab.count('E'), 5);
}

/// The Rhino's workcell with 2048 rows, so many that cover all of them, and one that covers none.
Workcell heaped(std::size_t covering) {
  Workcell workcell = test::workcell_named("rhino-xr3");
  workcell.camera->pixels_x = workcell.camera->pixels_y = 2048;
  const PointUm under = {workcell.camera->location_um.x, workcell.camera->location_um.y, 1000};
  workcell.blocks = {{"apart", {900'000, 900'000, 2000}, {under.x, 5'000'000, 1000}, 0, 1}};
  for (std::size_t i = 0; i < covering; ++i)
    workcell.blocks.edit().push_back({std::to_string(i), {900'000, 900'000, 2000}, under, 0, 1});
  return workcell;
}

TEST(Cell, RefusesBlocksWhosePictureWouldTakeTooLong) {
  constexpr std::size_t kMostCovering = kMaxCameraRows / 2048;
  const auto code = [](const call::Outcome& outcome) {
    const auto* refused = std::get_if<call::Refused>(&outcome);
    return refused == nullptr ? std::string() : refused->code;
  };
  Lab lab;
  EXPECT_EQ(code(lab.call(call::ReplaceWorkcell{heaped(kMostCovering)})), "");
  Block another = lab.cell.state().blocks.back();
  another.name = "another";
  EXPECT_EQ(code(lab.call(call::AddBlock{another})), "limit");
  EXPECT_EQ(code(lab.call(call::MoveBlock{"apart", another.centroid_um, {}})), "limit");
  EXPECT_EQ(code(lab.call(call::MoveBlock{"0", another.centroid_um, 45'000'000})), "");
  EXPECT_EQ(code(lab.call(call::RemoveBlock{"0"})), "");
  EXPECT_EQ(code(lab.call(call::MoveBlock{"apart", another.centroid_um, {}})), "");
  EXPECT_EQ(code(lab.call(call::AddBlock{another})), "limit");
}

TEST(Cell, BoundsTheNumberOfBlocksButNotInAReplay) {
  Lab lab;
  Workcell workcell = test::workcell_named("rhino-xr3");
  workcell.camera.reset();
  const Block block{"last", {9'000, 9'000, 9'000}, {300'000, 0, 4'500}, 0, 1};
  workcell.blocks.edit().assign(kMaxFileBlocks, block);
  for (std::size_t i = 0; i < kMaxFileBlocks; ++i)
    workcell.blocks.edit()[i].name = std::to_string(i);
  lab.call(call::ReplaceWorkcell{workcell});
  const call::Outcome outcome = lab.call(call::AddBlock{block});
  EXPECT_EQ(std::get<call::Refused>(outcome).message, "a workcell has at most 256 blocks");
  lab.cell.begin_replay();
  EXPECT_TRUE(std::holds_alternative<call::Done>(lab.call(call::AddBlock{block}, 0)));
}

TEST(Cell, ARealClockFollowsTheWallClockAtItsRate) {
  Lab lab(SimClock::real(Rate{2'000'000}, 100 * kMs));
  lab.open(1, 100 * kMs);
  lab.send(1, "E+50\r", 100 * kMs);
  lab.cell.catch_up(150 * kMs);
  EXPECT_EQ(lab.cell.state().tick, 100);
  EXPECT_EQ(lab.count('E'), 11);  // 100 ticks at 110 counts a second
}

TEST(Cell, ARealClockStopsAtTheLargestTick) {
  constexpr Tick kLast = (Tick{1} << 53) - 1;
  Lab lab;
  lab.call(call::RunUntil{kLast - 10, kLast});
  lab.call(call::Resume{});
  lab.cell.catch_up(7 * kMs);
  EXPECT_EQ(lab.cell.state().tick, kLast - 3);
  lab.cell.catch_up(1'000'000 * kMs);
  EXPECT_EQ(lab.cell.state().tick, kLast);
}

TEST(Cell, RepliesOnlyToTheLineOfTheInquiry) {
  Lab lab;
  lab.open(1);
  lab.open(2);
  lab.send(1, "E+7\r");
  EXPECT_EQ(lab.send(2, "E?"), "'");
  EXPECT_EQ(lab.cell.find_line(1)->outbox(), "");
}

TEST(Cell, TakesBytesUntilTheLimit) {
  Lab lab;
  lab.open(1);
  std::string bytes;
  for (int i = 0; i < 100; ++i) bytes += "E?";
  int asked = 0;
  const auto is_enough = [&asked] { return ++asked == 2; };
  EXPECT_EQ(lab.cell.apply(BytesIn{1, bytes}, 0, is_enough).bytes_taken, 2 * kMaxShownIn);
  EXPECT_EQ(lab.cell.find_line(1)->outbox().size(), kMaxShownIn);
  EXPECT_EQ(lab.cell.apply(BytesIn{1, "E?"}, 0, [] { return true; }).bytes_taken, 2U)
      << "there is always some progress";
}

TEST(Cell, StepAndRunUntilNeedTheManualClock) {
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

TEST(Cell, RunUntilReportsWhetherItReachedTheTarget) {
  Lab lab;
  lab.open(1);
  lab.send(1, "F+10\r");
  const auto outcome = std::get<call::Done>(lab.call(call::RunUntil{{}, 20}));
  EXPECT_EQ(outcome.reached, false);
  EXPECT_EQ(outcome.ran_ticks, 20);
  EXPECT_EQ(std::get<call::Done>(lab.call(call::RunUntil{Tick{50}, 1000})).reached, true);
  EXPECT_EQ(lab.cell.state().tick, 50);
}

TEST(Cell, ResetStartsANewEpochAndClearsTheParsers) {
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

TEST(Cell, ProblemsHaveOffsetBytesAndReason) {
  Lab lab;
  lab.open(1);
  lab.send(1, "E+5\rE+200\r");
  const auto problems = lab.notes<ProblemNote>();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "number_out_of_range");
  EXPECT_EQ(problems[0].offset, 4U);
  EXPECT_EQ(problems[0].raw.view(), "E+200\r");
  EXPECT_EQ(problems[0].message, "E+200: a move is -128...127 counts; ignored");
}

Block block_at_the_tip(const Lab& lab) {
  const PointUm tip = tool_tip(lab.cell.model(), Positions{});
  return {"red", {20'000, 20'000, 20'000}, tip, 90'000'000, 1};
}

TEST(Cell, AHomedLineThatDropsABlockGetsAWarningWithItsBytes) {
  Lab lab;
  lab.open(1);
  lab.call(call::AddBlock{block_at_the_tip(lab)});
  lab.send(1, "A+100\r");
  lab.call(call::RunUntil{{}, 100'000});
  lab.events.clear();
  lab.send(1, "A$");
  ASSERT_EQ(lab.events.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<Released>(std::get<EventBody>(lab.events[0].note)));
  const auto& problem = std::get<ProblemNote>(lab.events[1].note);
  EXPECT_EQ(problem.code, "released_in_air");
  EXPECT_EQ(problem.message.substr(0, 22), "block red was released");
  EXPECT_EQ(problem.raw.view(), "A$");
  EXPECT_TRUE(std::holds_alternative<Homed>(std::get<EventBody>(lab.events[2].note)));
  EXPECT_EQ(lab.cell.find_line(1)->warnings(), 1U);
}

TEST(Cell, ABlockThatACallPlacesInAnotherOneIsReported) {
  Lab lab;
  const auto overlaps = [&lab] {
    std::vector<std::string> pairs;
    for (const EventBody& body : lab.notes<EventBody>()) {
      const auto& warning = std::get<Warning>(body);
      EXPECT_EQ(warning.code, WarningCode::kBlocksOverlap);
      pairs.push_back(warning.block + " " + warning.other);
    }
    return pairs;
  };
  Block block = block_at_the_tip(lab);
  lab.call(call::AddBlock{block});
  EXPECT_TRUE(overlaps().empty());
  block.name = "blue";
  lab.call(call::AddBlock{block});
  EXPECT_EQ(overlaps(), (std::vector<std::string>{"blue red"}));
  lab.call(call::MoveBlock{"red", PointUm{0, 0, 0}, {}});
  EXPECT_EQ(overlaps().size(), 1U);
  lab.call(call::MoveBlock{"red", block.centroid_um, {}});
  EXPECT_EQ(overlaps(), (std::vector<std::string>{"blue red", "red blue"}));
  EXPECT_EQ(lab.cell.counters().warnings.at("blocks_overlap"), 2U);
}

TEST(Cell, TwoLinesThatMoveOneJointAreReported) {
  Lab lab;
  lab.open(1);
  lab.open(2);
  lab.send(1, "E+50\r");
  lab.call(call::Step{100});
  EXPECT_TRUE(lab.notes<ContestedNote>().empty());
  lab.send(2, "E+5\rE+5\r");
  ASSERT_EQ(lab.notes<ContestedNote>().size(), 1U);
  const CellEvent& contested = lab.events.at(lab.events.size() - 2);
  ASSERT_TRUE(std::holds_alternative<ContestedNote>(contested.note)) << "behind the first move";
  EXPECT_EQ(contested.line, 2U);
  EXPECT_EQ(contested.tick, 100);
  EXPECT_EQ(std::get<ContestedNote>(contested.note).other, 1U);
  EXPECT_EQ(std::get<ContestedNote>(contested.note).label, 'E');
}

TEST(Cell, ALineOpenedWhileDisabledGetsAProblem) {
  Lab lab;
  lab.open(1);
  lab.send(1, "A@");
  lab.open(2);
  ASSERT_EQ(lab.notes<ProblemNote>().size(), 1U);
  EXPECT_EQ(lab.notes<ProblemNote>()[0].code, "disabled");
  EXPECT_EQ(lab.send(2, "E?"), "");
  EXPECT_EQ(lab.send(2, "A@E?"), " ");
}

TEST(Cell, ALineIsNotOlderThanTheEpoch) {
  Lab lab;
  lab.call(call::Step{100});
  lab.open(1);
  lab.call(call::Step{100});
  lab.call(call::SaveSnapshot{"later"});
  EXPECT_EQ(lab.cell.find_line(1)->opened_tick(), 100);
  lab.call(call::Reset{});
  EXPECT_EQ(lab.cell.find_line(1)->opened_tick(), 0);
  lab.call(call::LoadSnapshot{"later", nullptr});
  EXPECT_EQ(lab.cell.find_line(1)->opened_tick(), 200);
}

TEST(Cell, AClosedLineTakesNoBytes) {
  Lab lab;
  lab.open(1);
  lab.cell.apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  EXPECT_EQ(lab.cell.apply(BytesIn{1, "E+5\r"}, 0).bytes_taken, 0U);
  EXPECT_EQ(lab.cell.lines().size(), 0U);
  EXPECT_EQ(lab.notes<LineClosedNote>().size(), 1U);
}

TEST(Cell, EventsAreInOrderOfTicks) {
  Lab lab(SimClock::real(Rate{}, 0));
  lab.open(1);
  lab.send(1, "E+3\rD+3\r");
  lab.cell.catch_up(1000 * kMs);
  for (std::size_t i = 1; i < lab.events.size(); ++i)
    EXPECT_LE(lab.events[i - 1].tick, lab.events[i].tick);
  EXPECT_EQ(lab.events.back().line, std::nullopt);
}

/// The ticks at which the machine's events were seen, and those of the events.
class EventTimes final : public CellObserver {
 public:
  std::vector<Tick> seen;
  std::vector<Tick> happened_at;
  Tick last = 0;

  void happened(const Cell& cell, const CellOutput& output) override {
    for (const CellEvent& event : output.events) {
      if (event.line) continue;
      seen.push_back(cell.state().tick);
      happened_at.push_back(event.tick);
    }
  }
  void ticked(const Cell& cell) override { last = cell.state().tick; }
};

TEST(Cell, AnObserverOfTicksSeesEventsInTheirTick) {
  Lab lab;
  lab.open(1);
  EventTimes times;
  lab.cell.observe(times, Cell::Ticks::kEach);
  for (int i = 0; i < 8; ++i) {
    lab.send(1, "E-127\r");
    lab.call(call::Step{2000});
  }
  lab.cell.end_observation(times);
  EXPECT_EQ(times.last, lab.cell.state().tick);
  EXPECT_FALSE(times.seen.empty()) << "the shoulder reaches its limit";
  EXPECT_EQ(times.seen, times.happened_at);
}

// --- Failures.

TEST(Cell, AnExceptionInAnObserverIsAFatalFailure) {
  Cell cell("main", test::rhino(), SimClock::manual());
  const test::OnEvent throws(cell, [](const CellEvent&) { throw std::bad_alloc(); });
  try {
    cell.apply(LineOpened{"test"}, 0);
    ADD_FAILURE() << "the exception of the observer is lost";
  } catch (const FatalFailure& failure) {
    EXPECT_STREQ(failure.what(), "the cell: std::bad_alloc");
  }
}

TEST(Cell, AFrozenCellIgnoresAllInput) {
  Lab lab(SimClock::real(Rate{1'000'000}, 0));
  lab.open(1);
  const State before = lab.cell.state();
  const std::size_t before_size = lab.events.size();
  lab.cell.freeze();
  lab.cell.apply(BytesIn{1, "E+5\rE?"}, 5 * kMs);
  lab.cell.apply(LineClosed{1}, 5 * kMs);
  lab.cell.catch_up(10 * kMs);
  EXPECT_EQ(lab.cell.state(), before);
  EXPECT_EQ(lab.events.size(), before_size);
}

TEST(Cell, AFrozenCellStillRemovesSentBytes) {
  Lab lab(SimClock::real(Rate{1'000'000}, 0));
  lab.open(1);
  lab.cell.apply(BytesIn{1, "E?"}, 0);
  lab.cell.freeze();
  ASSERT_EQ(lab.cell.find_line(1)->outbox(), " ");
  lab.cell.sent({1, 1});
  EXPECT_EQ(lab.cell.find_line(1)->outbox(), "");
  EXPECT_EQ(lab.cell.find_line(1)->bytes_out(), 1U);
}

// --- The camera.

ModelPtr rhino_with_camera(std::string_view workcell) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                       test::workcell_named(workcell), Profile::kPaper);
}

/// A cell with a camera and blocks, and actions on it.
class Seen {
 public:
  bool is_fresh() {
    return *cell_.camera_image() == xr3::camera_image(cell_.model(), cell_.state());
  }
  void bytes(std::string_view bytes) {
    cell_.apply(BytesIn{1, bytes}, 0);
    cell_.sent({1, cell_.find_line(1)->outbox().size()});
  }
  void call(const call::Call& call) { cell_.apply(Input{call}, 0); }
  void pass(Tick ticks) { call(call::Step{ticks}); }
  /// Moves the open jaws down around the first block.
  void go_to_a_block() {
    bytes("A$A-16\r");
    for (int i = 0; i < 6; ++i) {
      bytes(i < 3 ? "E+120\rD-120\r" : i == 3 ? "E+89\rD-120\r" : i == 4 ? "D-120\r" : "D-25\r");
      call(call::RunUntil{{}, 5000});
    }
  }
  Cell& cell() { return cell_; }

 private:
  Cell cell_{"main", rhino_with_camera("rhino-xr3"), SimClock::manual()};
  bool has_line_ = cell_.apply(LineOpened{"test"}, 0).line == 1;
};

TEST(Cell, RendersAnImageOncePerState) {
  Seen seen;
  const ImagePtr picture = seen.cell().camera_image();
  for (int i = 0; i < 100; ++i) seen.bytes("A**A*3*A*3,4*E+1\r");
  EXPECT_EQ(seen.cell().camera_image(), picture);
}

int any(int low, int high) { return *rc::gen::inRange(low, high + 1); }

std::string some_block() { return *rc::gen::element("red", "green", "blue", "none"); }

void something_happens(Seen& seen) {
  switch (any(0, 12)) {
    case 0: return seen.go_to_a_block();
    case 1:
    case 2: seen.bytes("AXA+100\r"); return seen.pass(any(1, 3000));
    case 3: seen.bytes("AXA-30\r"); return seen.pass(any(1, 500));
    case 4:
    case 5: seen.bytes("E-20\rF+9\r"); return seen.pass(any(1, 99));
    case 6: return seen.call(call::MoveBlock{some_block(), PointUm{200'000, 0, 20'000}, {}});
    case 7: return seen.call(call::RemoveBlock{some_block()});
    case 8:
      return seen.call(call::AddBlock{{some_block(), {40'000, 30'000, 20'000}, {99'000, 0, 0}}});
    case 9: return seen.call(call::SaveSnapshot{"kept"});
    case 10: return seen.call(call::LoadSnapshot{"kept", nullptr});
    case 11: return seen.call(call::Reset{});
    default:
      seen.call(call::ReplaceWorkcell{
          test::workcell_named(*rc::gen::element("rhino-xr3", "rhino-hundred", "adept-one"))});
  }
}

RC_GTEST_PROP(Cell, TheImageIsAlwaysThatOfTheState, ()) {
  Seen seen;
  for (int i = any(1, 40); i > 0; --i) {
    something_happens(seen);
    if (any(0, 2) == 0) seen.bytes(*rc::gen::element("A**", "A*60*", "A*82,96*"));
    RC_ASSERT(seen.is_fresh());
  }
}

TEST(Cell, SuspendedRepliesLeaveAtTheEndOfTheInput) {
  Lab lab;
  lab.open(1);
  lab.send(1,
           "\r\xff\xfb\x2c\xff\xfa\x2c\x08\xff\xf0"
           "E+5\rE?");
  const std::int64_t records = lab.cell.wires().next();
  const std::uint64_t bytes_out = lab.cell.counters().bytes_out;
  lab.cell.apply(InputEnded{1}, 0);
  EXPECT_EQ(lab.cell.find_line(1)->outbox(), "%");
  EXPECT_EQ(lab.cell.counters().bytes_out, bytes_out + 1);
  ASSERT_EQ(lab.cell.wires().next(), records + 1);
  EXPECT_NE(lab.cell.wires().at(records)->find("E: 5 counts to go"), std::string::npos);
  lab.cell.apply(InputEnded{1}, 0);
  EXPECT_EQ(lab.cell.wires().next(), records + 1) << "nothing else leaves";
}

}  // namespace
}  // namespace xr3
