#include "cell/recording/replayer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/support/models.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

using test::CellSetup;
using test::RecordedCell;
using test::replay;

constexpr WallNs kReplayMs = 1'000'000;

ModelPtr shipped_rhino() {
  static const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  return model;
}

void open_line(Cell& cell, WallNs now, LineKind kind = LineKind::kTcp) {
  cell.apply(LineOpened{"test", kind}, now);
}

std::string send_on(Cell& cell, LineId line, std::string_view bytes, WallNs now) {
  cell.apply(BytesIn{line, bytes}, now);
  std::string reply(cell.find_line(line)->outbox());
  cell.apply(BytesOut{line, reply.size()}, now);
  return reply;
}

TEST(Replayer, ComesToTheSameStateWithoutWallTime) {
  RecordedCell recorded(shipped_rhino());
  open_line(recorded.cell, 5 * kReplayMs);
  send_on(recorded.cell, 1, "E+50\r", 100 * kReplayMs);
  send_on(recorded.cell, 1, "E?", 700 * kReplayMs + 123'456);
  send_on(recorded.cell, 1, "C-20\rC?", 900 * kReplayMs);
  recorded.cell.catch_up(30'000 * kReplayMs);
  send_on(recorded.cell, 1, "E?", 30'000 * kReplayMs);
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.state, recorded.cell.state());
  EXPECT_EQ(replayed.hash, StateHasher().hash(recorded.cell));
  EXPECT_EQ(replayed.inputs, 5U);
}

/// The first difference of a recording in which a text was replaced, and the checks made anew.
std::string difference_after(RecordedCell& recorded,
                             const std::function<void(recording::Entry&)>& change) {
  recording::Writer writer;
  std::string text = writer.line(recording_header(recorded.cell, "xr3 test"));
  for (recording::Entry entry : recorded.entries()) {
    change(entry);
    text += writer.line(entry);
  }
  const auto replayed = replay(text);
  return replayed.difference ? to_text(*replayed.difference) : "";
}

template <class Kind>
auto changing(const std::function<void(Kind&)>& change) {
  return [change](recording::Entry& entry) {
    if (auto* body = std::get_if<Kind>(&entry.body)) change(*body);
  };
}

TEST(Replayer, TellsTheFirstDifference) {
  RecordedCell recorded(shipped_rhino());
  open_line(recorded.cell, 0);
  send_on(recorded.cell, 1, "E+50\rE?", 100 * kReplayMs);
  send_on(recorded.cell, 1, "E?", 15'000 * kReplayMs);
  using namespace recording;  // NOLINT: the entries
  EXPECT_EQ(difference_after(recorded, [](Entry&) {}), "");
  EXPECT_EQ(difference_after(recorded, changing<LineInput>([](LineInput& in) {
                               if (in.replies == "R") in.replies = "S";
                             })),
            "epoch 0, tick 100, line 1: reply: expected \"S\", found \"R\"");
  EXPECT_EQ(
      difference_after(recorded, changing<LineInput>([](LineInput& in) { in.replies += "!"; })),
      "epoch 0, tick 100, line 1: reply: expected \"!\" at tick 100, found no more bytes");
  EXPECT_EQ(difference_after(recorded, changing<LineInput>([](LineInput& in) { in.replies = ""; })),
            "epoch 0, tick 100, line 1: reply: expected no more bytes, found \"R\"");
  EXPECT_EQ(difference_after(recorded,
                             changing<StateHash>([](StateHash& state) { state.hash = "sha256:0"; }))
                .substr(0, 67),
            "epoch 0, tick 15000: digest of the state: expected sha256:0, found ");
  EXPECT_EQ(
      difference_after(recorded, changing<LineBegin>([](LineBegin& begin) { begin.line = 2; })),
      "epoch 0, tick 0: number of the line that opens: expected 2, found 1");
  EXPECT_EQ(difference_after(recorded, [](Entry& entry) { entry.epoch = 1; }),
            "epoch 0, tick 0: epoch: expected 1, found 0");
}

TEST(Replayer, StopsAtATime) {
  RecordedCell recorded(shipped_rhino(), {SimClock::manual()});
  open_line(recorded.cell, 0);
  send_on(recorded.cell, 1, "E+50\r", 0);
  const auto call = [&](const call::Call& each) { recorded.cell.apply(Input{each}, 0); };
  call(call::Step{300});
  const State wanted = recorded.cell.state();
  call(call::Step{100});
  call(call::RunUntil{std::nullopt, 100'000});
  const Tick rest = recorded.cell.state().tick;
  call(call::Reset{});
  call(call::Step{5});
  EXPECT_EQ(replay(recorded.text(), ReplayTime{0, 300}).state, wanted);
  EXPECT_EQ(replay(recorded.text(), ReplayTime{0, 350}).state.tick, 350);
  EXPECT_EQ(replay(recorded.text(), ReplayTime{0, rest - 1}).state.tick, rest - 1);
  EXPECT_EQ(replay(recorded.text(), ReplayTime{0, rest}).state.tick, rest) << "before the reset";
  EXPECT_EQ(replay(recorded.text(), ReplayTime{1, 5}).state, recorded.cell.state());
}

TEST(Replayer, AHostileRecordingDoesNotHarmIt) {
  RecordedCell recorded(shipped_rhino());
  open_line(recorded.cell, 0);
  send_on(recorded.cell, 1, "E?", 0);
  using namespace recording;  // NOLINT: the entries
  const std::vector<Body> bodies = {DeviceFound{},
                                    DeviceSent{7},
                                    DeviceInput{"x"},
                                    DeviceGone{""},
                                    LineInputEnd{9},
                                    LineEnd{9},
                                    LineUnsent{9, 1},
                                    LineUnsent{1, 1},
                                    LineInput{9, "E?", 2, 0, ""},
                                    LineSetup{9, {}, false},
                                    Late{0, false},
                                    Late{5, true},
                                    Replies{1, "x"},
                                    CallMade{call::Step{1}},
                                    CallMade{call::RunUntil{5, 5}},
                                    CallMade{call::RemoveBlock{"none"}},
                                    CallMade{call::StopDevice{}}};
  for (const Body& body : bodies) {
    const std::string text = difference_after(recorded, changing<LineInput>([](LineInput&) {}));
    EXPECT_EQ(text, "");
    const std::string changed = difference_after(recorded, [&](Entry& entry) {
      if (std::holds_alternative<LineInput>(entry.body)) entry.body = body;
    });
    if (!std::holds_alternative<Late>(body) || std::get<Late>(body).acts > 0)
      EXPECT_NE(changed, "") << "body " << body.index();
  }
  EXPECT_NE(difference_after(recorded, [](Entry& entry) { entry.us = 5; }), "");
  EXPECT_NE(difference_after(recorded,
                             [](Entry& entry) {
                               if (std::holds_alternative<LineInput>(entry.body)) {
                                 entry.tick = (Tick{1} << 53) - 1;
                                 std::get<LineInput>(entry.body).bytes = "";
                               }
                             }),
            "");
}

// --- A cell with random inputs.

/// A cell that gets random inputs at random wall times.
class Player {
 public:
  Player(RecordedCell& recorded, std::uint32_t seed) : cell_(recorded.cell), random_(seed) {}

  void play(int inputs) {
    for (int i = 0; i < inputs; ++i) {
      pass();
      act();
    }
  }

 private:
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }

  void pass() {
    constexpr WallNs kTimes[] = {0,          1'000,       999'999,      1'000'000,
                                 20'000'000, 300'000'000, 4'000'000'000};
    now_ += kTimes[below(7)] + (below(2) == 0 ? below(1'000'000) : 0);
    if (below(3) == 0) cell_.catch_up(now_);
  }

  void act() {
    switch (below(8)) {
      case 0: return open();
      case 1: return close();
      case 2: return call();
      case 3: return take();
      default: return send();
    }
  }

  void open() {
    constexpr LineKind kKinds[] = {LineKind::kTcp, LineKind::kTcp, LineKind::kPty,
                                   LineKind::kMonitor};
    if (cell_.lines().size() < 4) open_line(cell_, now_, kKinds[below(4)]);
  }
  LineId some_line() {
    if (cell_.lines().empty()) open_line(cell_, now_);
    auto line = cell_.lines().begin();
    std::advance(line, below(static_cast<std::uint32_t>(cell_.lines().size())));
    return line->first;
  }
  void close() {
    const LineId line = some_line();
    if (below(2) == 0) cell_.apply(InputEnded{line}, now_);
    if (below(2) == 0) cell_.apply(LineClosed{line, LineCloseReason::kDisconnected}, now_);
  }
  void take() {
    const LineId line = some_line();
    const auto waiting = static_cast<std::uint32_t>(cell_.find_line(line)->outbox().size());
    cell_.apply(BytesOut{line, below(waiting + 1)}, now_);
    if (below(4) == 0)
      cell_.apply(
          LineSettings{line, *parse_serial_settings(below(2) == 0 ? "9600-7e2" : "300-8n1")}, now_);
  }
  std::string bytes() {
    const std::vector<std::string> pieces = {
        "E?",
        "E+50\r",
        "C-90\r",
        "D?",
        "I",
        "V?",
        "A?",
        "E-1\r",
        "A$",
        "A@",
        "P5",
        "R3\r",
        "x\xff",
        "GET / HTTP/1.1\r\n",
        "CONNECT a",
        "A&1,1,1,3;",
        "A!",
        "\xff\xfd\x03",
        "\xff\xfb\x2c",
        std::string("\xff\xfa\x2c\x01\x00\x00\x25\x80\xff\xf0", 10),
        "\xff\xfa\x2c\x08\xff\xf0",
        "\xff\xfa\x2c\x09\xff\xf0",
        "J",
        "K",
        "T",
        "12",
        "\r",
        std::string(3000, '?')};
    std::string all;
    for (std::uint32_t i = below(6); i < 6; ++i)
      all += pieces[below(static_cast<std::uint32_t>(pieces.size()))];
    return all;
  }
  void send() {
    const LineId line = some_line();
    const std::string all = bytes();
    int pieces = 0;
    const int most = static_cast<int>(below(100));
    cell_.apply(BytesIn{line, all, [&] { return ++pieces > most; }}, now_);
    const SerialLine& its = *cell_.find_line(line);
    if (its.is_not_a_robot_program())
      return void(cell_.apply(LineClosed{line, LineCloseReason::kNotARobotProgram}, now_));
    if (below(3) != 0) cell_.apply(BytesOut{line, its.outbox().size()}, now_);
  }
  void call() {
    Fault fault;
    fault.name = "f" + std::to_string(below(3));
    constexpr FaultKind kKinds[] = {FaultKind::kByteDropped,      FaultKind::kReplyDelayed,
                                    FaultKind::kReplyBatched,     FaultKind::kXoffStall,
                                    FaultKind::kLineDisconnected, FaultKind::kPowerCycle,
                                    FaultKind::kMotorSlow,        FaultKind::kByteDoubled};
    fault.kind = kKinds[below(8)];
    fault.from_tick = cell_.state().tick + below(2000);
    fault.ticks = 1 + below(5000);
    if (fault.kind == FaultKind::kReplyDelayed) fault.delay_ms = 1 + below(900);
    if (fault.kind == FaultKind::kMotorSlow) fault.percent = 50, fault.joint = 'E';
    const bool is_once =
        fault.kind == FaultKind::kLineDisconnected || fault.kind == FaultKind::kPowerCycle;
    if (is_once) {
      fault.at_tick = std::exchange(fault.from_tick, std::nullopt);
      fault.ticks.reset();
    }
    const std::vector<call::Call> calls = {
        call::Pause{},
        call::Resume{},
        call::Resume{},
        call::SetRate{{1'000'000 + below(9'000'000)}},
        call::Step{below(3000)},
        call::RunUntil{std::nullopt, below(30'000)},
        call::RunUntil{cell_.state().tick + below(500), 1000},
        call::Reset{},
        call::Home{},
        call::Key{ToggleSimulator{}},
        call::Key{SetViewVector{1, -2, 3}},
        call::SetInput{static_cast<int>(1 + below(8)), below(2) == 0},
        call::MoveBlock{"red", PointUm{200'000, 100'000, 20'000}, std::nullopt},
        call::SaveSnapshot{"s"},
        call::LoadSnapshot{"s", nullptr},
        call::SetFault{fault,
                       below(2) == 0 ? std::optional<std::uint64_t>(below(9)) : std::nullopt},
        call::SetFault{fault, std::nullopt},
        call::ClearFault{""}};
    cell_.apply(Input{calls[below(static_cast<std::uint32_t>(calls.size()))]}, now_);
  }

  Cell& cell_;
  std::mt19937 random_;
  WallNs now_ = 0;
};

CellSetup random_setup() {
  CellSetup setup;
  setup.clock =
      *rc::gen::element(SimClock::real({}, 0), SimClock::real({50'000'000}, 0), SimClock::manual());
  const auto speed =
      *rc::gen::element<std::string>("", "auto", "9600-7e2", "115200-8n1", "4000000-8n1");
  if (speed == "auto") setup.line_speed = LineSpeed{std::nullopt, {}};
  if (!speed.empty() && speed != "auto")
    setup.line_speed = LineSpeed{parse_serial_settings(speed), {}};
  return setup;
}

RC_GTEST_PROP(Replayer, RepeatsAnyInputsAtAnyTimes, ()) {
  const CellSetup setup = random_setup();
  RecordedCell recorded(shipped_rhino(), setup);
  Player(recorded, *rc::gen::arbitrary<std::uint32_t>()).play(*rc::gen::inRange(1, 120));
  const auto replayed = replay(recorded.text());
  RC_ASSERT((replayed.difference ? to_text(*replayed.difference) : "") == std::string());
  RC_ASSERT(replayed.state == recorded.cell.state());
  RC_ASSERT(replayed.hash == StateHasher().hash(recorded.cell));
}

TEST(Replayer, RepeatsAnAdvanceInWhichTooManyBytesWereDue) {
  RecordedCell recorded(
      shipped_rhino(), {SimClock::real({}, 0), LineSpeed{parse_serial_settings("115200-8n1"), {}}});
  open_line(recorded.cell, 0);
  open_line(recorded.cell, 0);
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += "E?C+1\r";
  for (const LineId line : {1U, 2U}) recorded.cell.apply(BytesIn{line, bytes}, kReplayMs);
  for (int i = 1; i < 40; ++i) {
    recorded.cell.catch_up(i * 50 * kReplayMs);
    if (i % 3 == 0) recorded.cell.apply(BytesIn{1, "?"}, i * 50 * kReplayMs);
  }
  int late = 0;
  for (const auto& entry : recorded.entries())
    late += std::holds_alternative<recording::Late>(entry.body) ? 1 : 0;
  EXPECT_GT(late, 10);
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.hash, StateHasher().hash(recorded.cell));
}

TEST(Replayer, RepeatsAPacedLineWhoseClientDoesNotRead) {
  RecordedCell recorded(
      shipped_rhino(),
      {SimClock::real({}, 0), LineSpeed{parse_serial_settings("115200-8n1"), {100'000'000}}});
  Cell& cell = recorded.cell;
  open_line(cell, 0);
  WallNs now = 0;
  for (int i = 0; i < 3000; ++i) {
    now += kReplayMs / 4;
    cell.apply(BytesIn{1, i == 0 ? "E?" : std::string(60, '?')}, now);
    if (i % 700 == 650) {
      const std::size_t waiting = cell.find_line(1)->outbox().size();
      cell.apply(BytesOut{1, waiting / 2}, now);
      cell.apply(BytesOut{1, waiting / 4}, now);
    }
    if (i % 10 == 0)
      cell.apply(BytesOut{1, std::min<std::size_t>(9, cell.find_line(1)->outbox().size())}, now);
  }
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.hash, StateHasher().hash(cell));
}

TEST(Replayer, RepeatsADevice) {
  RecordedCell recorded(shipped_rhino(), {SimClock::real({}, 0), {}, {}, true});
  Cell& cell = recorded.cell;
  cell.apply(DeviceOpened{}, 0);
  open_line(cell, 0);
  send_on(cell, 1, "A@E?C?", kReplayMs);
  cell.apply(DeviceOut{2}, 2 * kReplayMs);
  for (int i = 1; i < 20; ++i) cell.catch_up(i * 173 * kReplayMs);
  cell.apply(DeviceOut{cell.device()->outbox().size()}, 4000 * kReplayMs);
  cell.apply(DeviceIn{"%!"}, 4001 * kReplayMs);
  cell.apply(DeviceLost{"unplugged"}, 5000 * kReplayMs);
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.hash, StateHasher().hash(cell));
  int silent = 0;
  for (const auto& entry : recorded.entries())
    silent += std::holds_alternative<recording::DeviceSilent>(entry.body) ? 1 : 0;
  EXPECT_GT(silent, 0);
}

}  // namespace
}  // namespace xr3
