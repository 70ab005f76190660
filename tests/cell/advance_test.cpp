// A cell whose lines have a speed: when bytes act and replies leave.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "cell/cell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr WallNs kPacedMs = 1'000'000;

class Paced {
 public:
  explicit Paced(const std::string& settings, SimClock clock = SimClock::manual())
      : cell("main", test::rhino(), clock) {
    cell.set_line_speed({parse_serial_settings(settings), Rate{}});
  }

  LineId open(LineKind kind = LineKind::kTcp) {
    return cell.apply(LineOpened{"test", kind}, 0).line;
  }
  std::size_t send(LineId line, std::string_view bytes) {
    return cell.apply(BytesIn{line, bytes}, 0).bytes_taken;
  }
  std::string take(LineId line) {
    const std::string bytes(cell.find_line(line)->outbox());
    cell.sent({line, bytes.size()});
    return bytes;
  }
  void step(Tick ticks) { cell.apply(Input{call::Call{call::Step{ticks}}}, 0); }
  void apply(call::Call call) { cell.apply(Input{std::move(call)}, 0); }
  /// Steps until the line has replied; returns the reply and the tick.
  std::pair<std::string, Tick> reply(LineId line) {
    for (int i = 0; i < 1000 && cell.find_line(line)->outbox().empty(); ++i) step(1);
    return {take(line), cell.state().tick};
  }
  std::vector<std::string> wires() {
    std::vector<std::string> all;
    monitor::Feed& feed = cell.wires();
    for (std::int64_t seq = feed.first(); seq < feed.next(); ++seq) all.push_back(*feed.at(seq));
    return all;
  }

  Cell cell;
};

TEST(PacedCell, AByteActsWhenItIsComplete) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  EXPECT_EQ(lab.send(line, "E?"), 2U);
  EXPECT_FALSE(lab.cell.is_at_rest());
  lab.step(2);
  EXPECT_EQ(lab.cell.find_line(line)->bytes_acted(), 1U);
  EXPECT_EQ(lab.cell.find_line(line)->bytes_in(), 2U);
  EXPECT_EQ(lab.reply(line), (std::pair<std::string, Tick>(" ", 4)));  // 3 * 1145.8 us
  EXPECT_TRUE(lab.cell.is_at_rest());
}

TEST(PacedCell, TwoHundredInquiriesTakeTheTimeOfTheLine) {
  Paced lab("9600-7e2");
  const LineId line = lab.open(LineKind::kPty);
  lab.send(line, std::string(200, 'I'));
  std::string replies;
  Tick last_input = 0;
  for (int i = 0; i < 300 && replies.size() < 200; ++i) {
    if (lab.cell.find_line(line)->bytes_acted() < 200) last_input = lab.cell.state().tick + 1;
    replies += lab.reply(line).first;
  }
  EXPECT_EQ(last_input, 230);             // 229,166 us
  EXPECT_EQ(lab.cell.state().tick, 231);  // and one reply, 1,145 us: 230,312
}

TEST(PacedCell, RunsUntilRestWithTheBytesUnderWay) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  lab.send(line, "E+5\rE?");
  lab.apply(call::RunUntil{std::nullopt, 1'000'000});
  EXPECT_TRUE(lab.cell.is_at_rest());
  EXPECT_EQ(lab.take(line), "%");
  EXPECT_EQ(lab.cell.state().motor(lab.cell.model().index_of('E')).count, 5);
}

TEST(PacedCell, ALimitStopsTheRunBeforeAByteIsDue) {
  Paced lab("300-8n1");
  const LineId line = lab.open();
  lab.send(line, "E?");
  lab.apply(call::RunUntil{std::nullopt, 20});
  EXPECT_EQ(lab.cell.state().tick, 20);
  EXPECT_EQ(next_due(lab.cell.value()), 34);
}

TEST(PacedCell, WaitingBytesAreBoundedAndNoneIsLost) {
  Paced lab("115200-8n1");
  const LineId line = lab.open(LineKind::kPty);
  const std::string flood(10'000, 'I');
  std::size_t sent = lab.send(line, flood);
  EXPECT_EQ(sent, LinePace::kMaxInput);
  EXPECT_FALSE(lab.cell.find_line(line)->accepts('I'));
  std::size_t replies = 0;
  for (int i = 0; i < 100 && replies < flood.size(); ++i) {
    lab.step(50);
    sent += lab.send(line, std::string_view(flood).substr(sent));
    replies += lab.take(line).size();
  }
  EXPECT_EQ(replies, flood.size());
}

TEST(PacedCell, WakesALineThatHasRoomAgain) {
  Paced lab("9600-7e2");
  const LineId line = lab.open(LineKind::kPty);
  lab.send(line, std::string(LinePace::kMaxInput, 'E'));
  lab.step(100);
  EXPECT_TRUE(lab.cell.take_woken_lines().empty());
  lab.step(2300);
  EXPECT_EQ(lab.cell.take_woken_lines(), std::vector{line});
}

TEST(PacedCell, RepliesThatAreNotReadStopTheInput) {
  Paced lab("1000000-8n1");
  const LineId line = lab.open(LineKind::kPty);
  std::size_t sent = 0;
  for (int i = 0; i < 100; ++i) {
    sent += lab.send(line, std::string(LinePace::kMaxInput, 'I'));
    lab.step(100);
  }
  const SerialLine& it = *lab.cell.find_line(line);
  EXPECT_GE(it.outbox().size(), SerialLine::kFullOutbox);
  EXPECT_LT(it.bytes_acted(), SerialLine::kFullOutbox + 2 * LinePace::kMaxInput);
  EXPECT_TRUE(lab.cell.is_at_rest());
  std::size_t replies = 0;
  for (int i = 0; i < 100 && replies < sent; ++i) {
    replies += lab.take(line).size();
    lab.step(100);
  }
  EXPECT_EQ(replies, sent);
}

TEST(PacedCell, TelnetTakesNoTime) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  lab.send(line, "E?\xff\xfd\x03");
  EXPECT_EQ(lab.send(line, "\xff\xfd\x03"), 3U);
  EXPECT_EQ(lab.take(line), "\xff\xfb\x03") << "answered at once, and once";
  lab.step(4);
  EXPECT_EQ(lab.take(line), " ");
}

TEST(PacedCell, SuspendedRepliesLeaveAtTheSpeedOfTheLine) {
  Paced lab("1000-8n1");
  const LineId line = lab.open();
  const std::string request = "\xff\xfa\x2c";
  const auto ask = [&](char code) { lab.send(line, request + code + "\xff\xf0"); };
  lab.send(line, "\xff\xfb\x2c");
  lab.take(line);
  ask('\x08');
  lab.send(line, "II");
  lab.step(100);
  EXPECT_EQ(lab.take(line), "");
  ask('\x09');
  lab.step(9);
  EXPECT_EQ(lab.take(line), "");
  lab.step(1);
  EXPECT_EQ(lab.take(line).size(), 1U);
  lab.step(10);
  EXPECT_EQ(lab.take(line).size(), 1U);
}

TEST(PacedCell, PurgeDropsBytesThatAreUnderWay) {
  Paced lab("1000-8n1");
  const LineId line = lab.open();
  lab.send(line, "\xff\xfb\x2c");
  lab.send(line, "III");
  lab.step(15);  // one inquiry has acted, and its reply is under way
  lab.take(line);
  lab.send(line, std::string("\xff\xfa\x2c\x0c\x02\xff\xf0"));
  EXPECT_EQ(lab.cell.find_line(line)->bytes_acted(), lab.cell.find_line(line)->bytes_in());
  lab.take(line);
  lab.step(100);
  EXPECT_EQ(lab.take(line).size(), 1U);
  lab.send(line, "I");
  lab.step(15);
  lab.send(line, std::string("\xff\xfa\x2c\x0c\x03\xff\xf0"));
  lab.take(line);
  lab.step(100);
  EXPECT_EQ(lab.take(line), "");
}

TEST(PacedCell, AfterTheEndOfInputQueuedBytesAct) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  lab.send(line, "E?");
  lab.cell.apply(InputEnded{line}, 0);
  EXPECT_FALSE(lab.cell.find_line(line)->is_drained());
  lab.step(4);
  EXPECT_TRUE(lab.cell.find_line(line)->is_drained());
  EXPECT_EQ(lab.take(line), " ");
}

TEST(PacedCell, AClosedLineDropsItsBytes) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  lab.send(line, "E+5\r");
  lab.step(3);
  lab.cell.apply(LineClosed{line}, 0);
  EXPECT_TRUE(lab.cell.is_at_rest());
  EXPECT_EQ(next_due(lab.cell.value()), std::nullopt);
}

TEST(PacedCell, BytesUnderWaySurviveAReset) {
  Paced lab("9600-7e2");
  const LineId line = lab.open();
  lab.step(1000);
  lab.send(line, "E?");
  lab.apply(call::Reset{});
  EXPECT_EQ(next_due(lab.cell.value()), 2);
  lab.step(4);
  EXPECT_EQ(lab.take(line), " ");
}

TEST(PacedCell, LinesOfTheMonitorTakeNoTime) {
  Paced lab("9600-7e2");
  const LineId line = lab.open(LineKind::kMonitor);
  lab.send(line, "E?");
  EXPECT_EQ(lab.take(line), " ");
}

TEST(PacedCell, TheSpeedOfTheClientCounts) {
  Paced lab("auto");
  const LineId raw = lab.open();
  lab.send(raw, "E?");
  EXPECT_EQ(lab.take(raw), " ") << "no speed is known";
  const LineId pty = lab.open(LineKind::kPty);
  lab.cell.apply(LineSettings{pty, {1000, std::nullopt}}, 0);
  lab.send(pty, "I");
  lab.step(21);
  EXPECT_EQ(lab.take(pty), "");
  lab.step(1);
  EXPECT_EQ(lab.take(pty).size(), 1U);
}

TEST(PacedCell, RecordsCommandsWhenTheyAct) {
  Paced lab("1000-8n1");
  const LineId line = lab.open();
  lab.send(line, "E+5\rE?\xff\xfd\x03");
  lab.send(line, "\xff\xfd\x03");
  lab.step(1000);
  std::vector<std::tuple<Tick, std::string, std::string>> shown;
  for (const std::string& text : lab.wires()) {
    const auto json = nlohmann::json::parse(text);
    shown.emplace_back(json["tick"], json["dir"], json["text"]);
  }
  EXPECT_EQ(shown, (decltype(shown){{0, "in", "\\xff\\xfd\\x03"},
                                    {0, "out", "\\xff\\xfb\\x03"},
                                    {0, "in", "\\xff\\xfd\\x03"},
                                    {40, "in", "E+5\\r"},
                                    {60, "in", "E?"},
                                    {70, "out", "#"}}));
}

TEST(PacedCell, AnAdvanceOfRealTimeStopsAfterManyDueBytes) {
  Paced lab("1000000-8n1", SimClock::real(Rate{}, 0));  // 100 bytes a tick and direction
  const LineId line = lab.open(LineKind::kPty);
  lab.cell.apply(BytesIn{line, std::string(4000, 'I')}, 0);
  lab.cell.catch_up(1000 * kPacedMs);
  EXPECT_EQ(lab.cell.state().tick, 2);
  EXPECT_EQ(lab.cell.find_line(line)->bytes_acted(), 200U) << "all that are due";
  EXPECT_EQ(next_due(lab.cell.value()), 3);
  EXPECT_EQ(lab.cell.clock().at(1000 * kPacedMs), 2) << "the clock goes on from there";
  EXPECT_EQ(lab.cell.clock().when(3), 1001 * kPacedMs);
  lab.cell.catch_up(1010 * kPacedMs);
  EXPECT_EQ(lab.cell.state().tick, 4);
  for (int ms = 1020; ms < 2020; ms += 10) lab.cell.catch_up(ms * kPacedMs);
  EXPECT_EQ(lab.cell.find_line(line)->outbox().size(), 4000U);
  lab.cell.catch_up(5000 * kPacedMs);
  EXPECT_GT(lab.cell.state().tick, 3000) << "few bytes do not stop it";
}

TEST(PacedCell, ATickOfTheRealClockHasABoundedNumberOfDueBytes) {
  Paced lab("4000000000-8n1", SimClock::real(Rate{}, 0));
  const LineId line = lab.open(LineKind::kPty);
  lab.send(line, std::string(4000, 'I'));
  const auto due = [&] {
    const SerialLine& its = *lab.cell.find_line(line);
    return its.bytes_acted() + its.outbox().size();
  };
  lab.cell.catch_up(1 * kPacedMs);
  EXPECT_EQ(lab.cell.state().tick, 0) << "some bytes are due in less than a microsecond";
  const std::uint64_t before = due();
  EXPECT_LT(before, kMaxTickBytes);
  lab.cell.catch_up(2 * kPacedMs);
  EXPECT_EQ(lab.cell.state().tick, 1);
  EXPECT_EQ(due() - before, kMaxTickBytes);
  EXPECT_EQ(next_due(lab.cell.value()), 2);
  for (int ms = 3; ms < 12; ++ms) lab.cell.catch_up(ms * kPacedMs);
  EXPECT_EQ(due(), 8000U);
  EXPECT_EQ(next_due(lab.cell.value()), std::nullopt);
  lab.take(line);
  lab.apply(call::Reset{});
  lab.send(line, "E?");
  lab.cell.catch_up(1 * kPacedMs);
  EXPECT_EQ(lab.take(line), " ") << "a new epoch begins anew";
}

TEST(PacedCell, AStepExecutesAllThatIsDue) {
  Paced lab("4000000000-8n1");
  const LineId line = lab.open(LineKind::kPty);
  lab.send(line, std::string(4000, 'I'));
  lab.step(1);
  EXPECT_EQ(lab.take(line).size(), 4000U);
}

/// A script of sends and steps, whose result must not depend on how time is cut into steps.
std::string outcome(const std::vector<std::pair<std::string, Tick>>& script, Tick piece) {
  Paced lab("9600-7e2");
  const std::vector<LineId> lines = {lab.open(), lab.open()};
  for (std::size_t i = 0; i < script.size(); ++i) {
    lab.send(lines[i % 2], script[i].first);
    for (Tick left = script[i].second; left > 0; left -= piece) lab.step(std::min(left, piece));
  }
  lab.apply(call::RunUntil{std::nullopt, 1'000'000});
  std::string all;
  for (const LineId line : lines) all += lab.take(line) + "|";
  for (const MotorState& motor : lab.cell.state().motors) all += std::to_string(motor.count) + " ";
  return all + std::to_string(lab.cell.state().tick);
}

RC_GTEST_PROP(PacedCell, StepsOfAnySizeGiveTheSameResult, ()) {
  using Entry = std::pair<std::string, Tick>;
  const auto script = *rc::gen::container<std::vector<Entry>>(
      rc::gen::pair(rc::gen::container<std::string>(rc::gen::elementOf(std::string("EFI?+-2\r"))),
                    rc::gen::inRange<Tick>(0, 40)));
  RC_ASSERT(outcome(script, 1) == outcome(script, 1000));
}

}  // namespace
}  // namespace xr3
