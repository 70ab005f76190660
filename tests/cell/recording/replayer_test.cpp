#include "cell/recording/replayer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "tests/support/models.hpp"
#include "tests/support/random_inputs.hpp"
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
  cell.sent({line, reply.size()});
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
  recording::RecordingWriter writer;
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
  const std::vector<EntryBody> bodies = {DeviceOpened{},
                                         DeviceOut{7},
                                         DeviceInput{"x"},
                                         DeviceLost{""},
                                         InputEnded{9},
                                         LineClosed{9},
                                         LineUnsent{9, 1},
                                         LineUnsent{1, 1},
                                         LineInput{9, "E?", 2, 0, ""},
                                         LineSettings{9, {}, false},
                                         Replies{1, "x"},
                                         CallMade{call::Step{1}},
                                         CallMade{call::RunUntil{5, 5}},
                                         CallMade{call::RemoveBlock{"none"}},
                                         CallMade{call::StopDevice{}}};
  for (const EntryBody& body : bodies) {
    const std::string text = difference_after(recorded, changing<LineInput>([](LineInput&) {}));
    EXPECT_EQ(text, "");
    const std::string changed = difference_after(recorded, [&](Entry& entry) {
      if (std::holds_alternative<LineInput>(entry.body)) entry.body = body;
    });
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
  test::RandomInputs(recorded.cell, *rc::gen::arbitrary<std::uint32_t>())
      .play(*rc::gen::inRange(1, 120));
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
  EXPECT_LT(recorded.cell.state().tick, 39 * 50) << "simulated time lags";
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.hash, StateHasher().hash(recorded.cell));
}

TEST(Replayer, RepeatsALineThatPassesMoreBytesThanATickMayHave) {
  RecordedCell recorded(shipped_rhino(), {SimClock::real({}, 0), LineSpeed{std::nullopt, {}}});
  Cell& cell = recorded.cell;
  for (int line = 0; line < 2; ++line) open_line(cell, 0, LineKind::kPty);
  const std::string bytes(3000, 'I');
  for (int ms = 1; ms < 20; ++ms) {
    for (const LineId line : {1U, 2U}) {
      cell.apply(LineSettings{line, {4'000'000'000U - static_cast<unsigned>(ms), {}}},
                 ms * kReplayMs);
      cell.apply(BytesIn{line, bytes}, ms * kReplayMs + line * kReplayMs / 3);
      if (ms % 3 == 0) cell.sent({line, cell.find_line(line)->outbox().size() / 2});
    }
  }
  cell.catch_up(50 * kReplayMs);
  const auto replayed = replay(recorded.text());
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.hash, StateHasher().hash(cell));
}

TEST(Replayer, RepeatsACutOfALineThatLags) {
  RecordedCell recorded(shipped_rhino(),
                        {SimClock::real({}, 0), LineSpeed{parse_serial_settings("9600-7e2"), {}}});
  open_line(recorded.cell, 0);
  Fault fault{.name = "cut", .kind = FaultKind::kLineDisconnected};
  fault.at_tick = 900;
  recorded.cell.apply(Input{call::Call{call::SetFault{fault, std::nullopt}}}, 0);
  std::string moves;
  for (int i = 0; i < 750; ++i) moves += "E+1\r";
  recorded.cell.apply(BytesIn{1, moves}, 0);
  recorded.cell.catch_up(4000 * kReplayMs);
  EXPECT_LT(recorded.cell.state().tick, 900) << "the cut is still to come";
  for (int ms = 4000; ms < 8000; ms += 100) recorded.cell.catch_up(ms * kReplayMs);
  EXPECT_GT(recorded.cell.state().tick, 900);
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
  for (int i = 0; i < 1500; ++i) {
    now += kReplayMs / 4;
    cell.apply(BytesIn{1, i == 0 ? "E?" : std::string(60, '?')}, now);
    if (i % 700 == 650) {
      const std::size_t waiting = cell.find_line(1)->outbox().size();
      cell.sent({1, waiting / 2});
      cell.sent({1, waiting / 4});
    }
    if (i % 10 == 0) cell.sent({1, std::min<std::size_t>(9, cell.find_line(1)->outbox().size())});
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
