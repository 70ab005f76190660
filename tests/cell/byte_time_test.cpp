// A cell with the byte clock: when bytes act, whose turn it is, and what the transcript tells.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr Micros kUsualCharacter = 1'146;
constexpr Micros kUsualInquiry = 20'000;

/// The Rhino with its blocks and its camera.
ModelPtr rhino_at_work() {
  static const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  return model;
}

class ByteLab {
 public:
  explicit ByteLab(const ByteClockSettings& settings = {},
                   const std::optional<LineSpeed>& speed = {})
      : cell("main", rhino_at_work(), SimClock::bytes()) {
    cell.set_byte_clock(settings, speed);
  }

  LineId open(LineKind kind = LineKind::kTcp) {
    return cell.apply(LineOpened{"test", kind}, wall).line;
  }
  std::size_t send(LineId line, std::string_view bytes) {
    return cell.apply(BytesIn{line, bytes}, wall).bytes_taken;
  }
  std::string take(LineId line) {
    const std::string bytes(cell.find_line(line)->outbox());
    cell.sent({line, bytes.size()});
    return bytes;
  }
  std::string ask(LineId line, std::string_view bytes) {
    send(line, bytes);
    return take(line);
  }
  void close(LineId line, LineCloseReason reason = LineCloseReason::kClientClosed) {
    cell.apply(LineClosed{line, reason}, wall);
  }
  call::Outcome apply(call::Call call) { return cell.apply(Input{std::move(call)}, wall).outcome; }
  std::string refusal(call::Call call) {
    const call::Outcome outcome = apply(std::move(call));
    const auto* refused = std::get_if<call::Refused>(&outcome);
    return refused == nullptr ? "" : refused->code;
  }
  Tick tick() const { return cell.state().tick; }
  Micros time() const { return micros_at(tick()) + cell.clock_remainder(); }
  const MotorState& motor(char label) const {
    return cell.state().motor(cell.model().index_of(label));
  }
  std::string digest() const {
    return transcript_digest(cell.transcript()->summary(), cell.model(), cell.state(),
                             cell.clock_remainder());
  }
  std::vector<std::string> marks() const {
    std::vector<std::string> names;
    for (const TranscriptMark mark : cell.transcript()->summary().marks)
      names.emplace_back(name_of(mark));
    return names;
  }
  /// The codes of all events, or of those with this one.
  std::vector<std::string> events(std::string_view only = "") {
    std::vector<std::string> codes;
    monitor::Feed& feed = cell.events();
    for (std::int64_t seq = feed.first(); seq < feed.next(); ++seq) {
      const auto code = Json::parse(*feed.at(seq))["code"].get<std::string>();
      if (only.empty() || code == only) codes.push_back(code);
    }
    return codes;
  }

  WallNs wall = 0;
  Cell cell;
};

using Marks = std::vector<std::string>;
const Marks kNoMarks;

// --- Time.

TEST(ByteClockCell, AByteMovesTimeOneCharacter) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "E");
  EXPECT_EQ(lab.time(), kUsualCharacter);
  lab.wall = 1'000'000'000'000;
  lab.cell.catch_up(lab.wall);
  EXPECT_EQ(lab.time(), kUsualCharacter) << "wall time does not";
  lab.send(line, std::string(999, 'E'));
  EXPECT_EQ(lab.time(), 1'000 * kUsualCharacter) << "without drift";
}

TEST(ByteClockCell, TimePassesBeforeAnInquiryAndWithItsReply) {
  ByteLab lab;
  const LineId line = lab.open();
  EXPECT_EQ(lab.ask(line, "E+5\rE?"), "#") << "after 22.3 ms at 110 counts a second";
  EXPECT_EQ(lab.time(), 7 * kUsualCharacter + kUsualInquiry);
  lab.send(line, "G?");
  EXPECT_EQ(lab.time(), 10 * kUsualCharacter + 2 * kUsualInquiry) << "joint G is not there";
  for (const char* inquiry : {"ET", "EV", "I", "J", "K"}) {
    const Micros before = lab.time();
    lab.ask(line, inquiry);
    EXPECT_GT(lab.time() - before, kUsualInquiry) << inquiry;
  }
}

TEST(ByteClockCell, ACommandOfOneByteWithAnInquiryActsInOrder) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "E+5?");  // the inquiry ends the number
  EXPECT_EQ(lab.take(line), "#") << "the move came first, 20 ms before";
  const std::vector<std::string> codes = lab.events();
  EXPECT_EQ(codes[1], "move");
}

TEST(ByteClockCell, EveryByteOfAnImageTakesItsTime) {
  ByteLab lab;
  const LineId line = lab.open();
  const std::string image = lab.ask(line, "A**");
  EXPECT_GT(image.size(), 1000U);
  const auto characters = static_cast<Micros>(3 + image.size());
  EXPECT_EQ(lab.time(), characters * kUsualCharacter + kUsualInquiry);
}

TEST(ByteClockCell, TelnetTakesNoTimeAndFfCountsOnce) {
  ByteLab lab;
  const LineId line = lab.open();
  EXPECT_EQ(lab.ask(line, "\xff\xfd\x03"), "\xff\xfb\x03");
  EXPECT_EQ(lab.time(), 0);
  EXPECT_EQ(lab.cell.transcript()->summary().bytes_in, 0U);
  lab.send(line, std::string("\xff\xff"));
  EXPECT_EQ(lab.time(), kUsualCharacter) << "one byte of data";
}

TEST(ByteClockCell, BrowsersMoveNoTime) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "GET / HTTP/1.1\r\n");
  EXPECT_TRUE(lab.cell.find_line(line)->is_not_a_robot_program());
  EXPECT_EQ(lab.time(), 0);
}

TEST(ByteClockCell, BytesThatTheDetectorHoldsActTogetherLater) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "P");
  EXPECT_EQ(lab.time(), 0) << "as in PUT or POST";
  lab.send(line, "1");
  EXPECT_EQ(lab.time(), 2 * kUsualCharacter);
}

TEST(ByteClockCell, LineSpeedSetsTheTimeOfACharacter) {
  ByteLab slow({}, LineSpeed{parse_serial_settings("1000-8n1"), Rate{}});
  const LineId line = slow.open();
  EXPECT_EQ(slow.send(line, "EEE"), 3U) << "nothing is queued";
  EXPECT_EQ(slow.time(), 30'000);
  EXPECT_EQ(slow.cell.find_line(line)->bytes_acted(), 3U);
  EXPECT_EQ(text_of(*speed_of(slow.cell.value(), *slow.cell.find_line(line))), "1000-8n1");
}

TEST(ByteClockCell, WithAutoTheClientSetsIt) {
  ByteLab lab({}, LineSpeed{std::nullopt, Rate{}});
  const LineId line = lab.open();
  lab.send(line, "E");
  EXPECT_EQ(lab.time(), kUsualCharacter);
  lab.send(line, std::string("\xff\xfb\x2c\xff\xfa\x2c\x01\0\0\x03\xe8\xff\xf0", 13));  // 1000 baud
  const Micros before = lab.time();
  lab.send(line, "E");
  EXPECT_EQ(lab.time() - before, 11'000) << "7e2 until the client sets another frame";
  EXPECT_EQ(lab.marks(), kNoMarks) << "the setting is among the bytes";
}

TEST(ByteClockCell, ATerminalThatChangesItsSpeedLateMarksTheTranscript) {
  ByteLab lab({}, LineSpeed{std::nullopt, Rate{}});
  const LineId line = lab.open(LineKind::kPty);
  lab.cell.apply(LineSettings{line, {300, std::nullopt}, false}, 0);
  lab.send(line, "E");
  EXPECT_EQ(lab.time(), 36'667) << "11 bits";
  lab.cell.apply(LineSettings{line, {300, std::nullopt}, false}, 0);
  EXPECT_EQ(lab.marks(), kNoMarks);
  lab.cell.apply(LineSettings{line, {600, std::nullopt}, false}, 0);
  EXPECT_EQ(lab.marks(), Marks{"not_bytes_alone"});
}

// --- Calls.

TEST(ByteClockCell, PauseStopsItAndResumeRestoresIt) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "E");
  lab.apply(call::Pause{});
  EXPECT_EQ(lab.cell.clock().mode(), ClockMode::kManual);
  EXPECT_EQ(lab.ask(line, "+5\rE?"), "%");
  EXPECT_EQ(lab.time(), kUsualCharacter);
  lab.apply(call::Step{5});
  EXPECT_EQ(lab.tick(), 6);
  lab.wall = 1'000'000'000'000;
  lab.apply(call::Resume{});
  EXPECT_EQ(lab.cell.clock().mode(), ClockMode::kBytes);
  EXPECT_EQ(lab.tick(), 6);
  lab.send(line, "E");
  EXPECT_EQ(lab.time(), 6'000 + 146 + kUsualCharacter) << "with its remainder";
  EXPECT_EQ(lab.marks(), Marks{"not_bytes_alone"});
}

TEST(ByteClockCell, RefusesARate) {
  ByteLab lab;
  EXPECT_EQ(lab.refusal(call::SetRate{{2'000'000}}), "no_rate");
  lab.apply(call::Pause{});
  EXPECT_EQ(lab.refusal(call::SetRate{{2'000'000}}), "no_rate") << "it would have none afterwards";
}

TEST(ByteClockCell, StepsWithoutAPause) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "E+100\r");
  const Tick before = lab.tick();
  EXPECT_EQ(lab.refusal(call::Step{100}), "");
  EXPECT_EQ(lab.tick(), before + 100);
  EXPECT_EQ(lab.refusal(call::RunUntil{std::nullopt, 100'000}), "");
  EXPECT_EQ(lab.motor('E').count, 100);
  EXPECT_EQ(lab.cell.clock().at(0), lab.tick());
}

TEST(ByteClockCell, AnEpochBeginsWithoutARemainder) {
  ByteLab lab;
  LineId line = lab.open();
  lab.send(line, "E");
  lab.close(line);
  lab.apply(call::SaveSnapshot{"one"});
  EXPECT_EQ(lab.marks(), kNoMarks);
  lab.apply(call::Reset{});
  EXPECT_EQ(lab.time(), 0);
  lab.apply(call::LoadSnapshot{"one", nullptr});
  EXPECT_EQ(lab.time(), 1'000);
  EXPECT_EQ(lab.cell.transcript()->summary(), Transcript{}.summary()) << "it begins anew";
  line = lab.open();
  lab.apply(call::Reset{});
  EXPECT_EQ(lab.marks(), Marks{"not_bytes_alone"}) << "a line was open";
}

TEST(ByteClockCell, ARecorderCanRestoreTheRemainder) {
  ByteLab lab;
  lab.cell.set_clock_remainder(854);
  lab.send(lab.open(), "E");
  EXPECT_EQ(lab.tick(), 2);
  EXPECT_EQ(lab.cell.clock_remainder(), 0);
}

// --- Turns and rest.

TEST(ByteClockCell, ObeysOneLineAtATime) {
  ByteLab lab;
  const LineId first = lab.open();
  const LineId second = lab.open(LineKind::kPty);
  const LineId third = lab.open(LineKind::kMonitor);
  EXPECT_EQ(line_before(lab.cell.value(), first), std::nullopt);
  EXPECT_EQ(line_before(lab.cell.value(), third), first);
  EXPECT_EQ(lab.events("line_waits").size(), 2U) << "each is told once";
  EXPECT_EQ(lab.send(second, "E+5\r"), 0U);
  EXPECT_EQ(lab.time(), 0);
  lab.send(first, "E+100\r");
  lab.close(first);
  EXPECT_EQ(lab.motor('E').count, 100) << "the robot has run to rest";
  EXPECT_EQ(lab.cell.take_woken_lines(), std::vector{second});
  EXPECT_EQ(lab.events("line_turn").size(), 1U);
  EXPECT_EQ(lab.send(second, "E-5\r"), 4U);
  lab.close(third);
  EXPECT_EQ(lab.motor('E').count, 100) << "a line that waited ends without effect";
  lab.close(second);
  EXPECT_EQ(lab.motor('E').count, 95);
  EXPECT_EQ(lab.events("contested").size(), 0U);
  EXPECT_EQ(lab.marks(), kNoMarks);
}

TEST(ByteClockCell, NothingMovesWhileNoLineIsOpen) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.apply(call::Pause{});
  lab.send(line, "E+100\r");
  lab.close(line);
  EXPECT_EQ(lab.motor('E').count, 0) << "time is paused";
  lab.apply(call::Resume{});
  EXPECT_EQ(lab.motor('E').count, 100);
}

TEST(ByteClockCell, ConcurrentLinesAreObeyedTogether) {
  ByteLab lab({.has_concurrent_lines = true});
  const LineId first = lab.open();
  const LineId second = lab.open();
  EXPECT_EQ(line_before(lab.cell.value(), second), std::nullopt);
  lab.send(first, "E+100\r");
  lab.send(second, "D+10\r");
  lab.close(first);
  EXPECT_LT(lab.motor('E').count, 100) << "another line is open";
  lab.close(second);
  EXPECT_EQ(lab.motor('E').count, 100);
  EXPECT_EQ(lab.marks(), Marks{"arrival_order"});
  lab.apply(call::Reset{});
  EXPECT_EQ(lab.marks(), Marks{"arrival_order"});
}

TEST(ByteClockCell, RestEndsAfterAnHour) {
  ByteLab lab;
  Fault stuck;
  stuck.name = "stuck";
  stuck.kind = FaultKind::kMotorStuck;
  stuck.joint = 'E';
  stuck.at_tick = 0;
  stuck.ticks = 100 * kMaxSleep;
  lab.apply(call::SetFault{stuck, std::nullopt});
  const LineId line = lab.open();
  lab.send(line, "E+5\r");
  const Tick before = lab.tick();
  lab.close(line);
  EXPECT_EQ(lab.tick() - before, kMaxSleep);
}

TEST(ByteClockCell, SilenceRunsTheRobotToRest) {
  ByteLab lab({.settle_ms = 100});
  const LineId line = lab.open();
  lab.cell.apply(LineSilent{line}, 0);
  EXPECT_EQ(lab.marks(), kNoMarks) << "it was at rest";
  lab.send(line, "E+100\r");
  lab.cell.apply(LineSilent{line + 1}, 0);
  EXPECT_LT(lab.motor('E').count, 100) << "another line";
  lab.cell.apply(LineSilent{line}, 0);
  EXPECT_EQ(lab.motor('E').count, 100);
  EXPECT_EQ(lab.marks(), Marks{"silence"});
}

TEST(ByteClockCell, TheServersEndDoesNotMoveTheRobot) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, "E+100\r");
  lab.close(line, LineCloseReason::kShutdown);
  EXPECT_LT(lab.motor('E').count, 100);
}

// --- Faults.

Fault fault_of(FaultKind kind) {
  Fault fault;
  fault.name = "f";
  fault.kind = kind;
  return fault;
}

TEST(ByteClockCell, ADelayPassesAtOnce) {
  ByteLab lab;
  Fault delay = fault_of(FaultKind::kReplyDelayed);
  delay.delay_ms = 500;
  delay.from_tick = 0;
  lab.cell.set_faults({7, {delay}});
  const LineId line = lab.open();
  EXPECT_EQ(lab.ask(line, "E?"), " ");
  EXPECT_EQ(lab.tick(), 500 + 22 + 1);
}

TEST(ByteClockCell, XoffWithoutAnEndHoldsRepliesAndBytesGoOn) {
  ByteLab lab;
  Fault xoff = fault_of(FaultKind::kXoffStall);
  xoff.from_tick = 0;
  lab.cell.set_faults({7, {xoff}});
  const LineId line = lab.open();
  EXPECT_EQ(lab.ask(line, "E?"), "");
  EXPECT_EQ(lab.ask(line, "E?"), "");
  lab.apply(call::ClearFault{});
  EXPECT_EQ(lab.take(line), "  ");
  EXPECT_EQ(lab.time(), 6 * kUsualCharacter + 2 * kUsualInquiry);
}

TEST(ByteClockCell, ALineThatIsCutInTheTimeOfAnInquiryDoesNotObeyIt) {
  ByteLab lab;
  Fault cut = fault_of(FaultKind::kLineDisconnected);
  cut.at_tick = 10;
  lab.cell.set_faults({7, {cut}});
  const LineId line = lab.open();
  EXPECT_EQ(lab.send(line, "E?E+5\r"), 2U);
  EXPECT_EQ(lab.take(line), "");
  EXPECT_TRUE(lab.cell.find_line(line)->is_cut());
  EXPECT_EQ(lab.send(line, "E+5\r"), 0U);
}

TEST(ByteClockCell, SuspendedRepliesTakeTheirTimeAsTheyLeave) {
  ByteLab lab;
  const LineId line = lab.open();
  lab.send(line, std::string("\xff\xfb\x2c\xff\xfa\x2c\x08\xff\xf0"));
  lab.take(line);
  lab.send(line, "E?");
  EXPECT_EQ(lab.time(), 2 * kUsualCharacter + kUsualInquiry);
  lab.send(line, std::string("\xff\xfa\x2c\x09\xff\xf0"));
  EXPECT_EQ(lab.time(), 3 * kUsualCharacter + kUsualInquiry);
}

// --- Hurry.

TEST(ByteClockCell, TellsOnceThatAProgramDoesNotAsk) {
  ByteLab lab;
  const LineId line = lab.open();
  const auto hurries = [&lab] { return lab.events("byte_clock_hurry").size(); };
  lab.send(line, "E+50\rD+50\r");
  EXPECT_EQ(hurries(), 0U) << "two joints";
  lab.send(line, "E+50\rE-5\rDX");
  EXPECT_EQ(hurries(), 1U) << "a run of them";
  lab.send(line, "E?E+5\r");
  EXPECT_EQ(hurries(), 1U) << "it has asked";
  lab.send(line, "EX");
  EXPECT_EQ(hurries(), 2U);
  lab.close(line);
  lab.send(lab.open(), "E+5\r");
  EXPECT_EQ(hurries(), 2U) << "it has arrived";
}

// --- The transcript.

TEST(ByteClockCell, EndsThatTheBytesDoNotDecideMarkTheTranscript) {
  using enum LineCloseReason;
  const auto marks_after = [](LineCloseReason reason) {
    ByteLab lab;
    const LineId line = lab.open();
    lab.send(line, "E");
    lab.close(line, reason);
    return lab.marks();
  };
  for (const LineCloseReason reason : {kClientClosed, kNotARobotProgram, kFault})
    EXPECT_EQ(marks_after(reason), kNoMarks);
  for (const LineCloseReason reason : {kError, kMemory, kDisconnected})
    EXPECT_EQ(marks_after(reason), Marks{"not_bytes_alone"});
}

TEST(ByteClockCell, CallsThatChangeTheCellMarkTheTranscript) {
  const auto marks_after = [](call::Call call) {
    ByteLab lab;
    lab.apply(std::move(call));
    return lab.marks();
  };
  EXPECT_EQ(marks_after(call::SaveSnapshot{"a"}), kNoMarks);
  EXPECT_EQ(marks_after(call::Reset{}), kNoMarks);
  EXPECT_EQ(marks_after(call::MoveBlock{"no such block", {}, {}}), kNoMarks) << "refused";
  for (const call::Call& call :
       std::initializer_list<call::Call>{call::Pause{}, call::Step{1}, call::Home{},
                                         call::SetInput{1, true}, call::RemoveBlock{"red"}})
    EXPECT_EQ(marks_after(call), Marks{"not_bytes_alone"});
}

TEST(ByteClockCell, OtherClocksHaveNoTranscript) {
  for (const SimClock& clock : {SimClock::manual(), SimClock::real({}, 0)}) {
    Cell cell("main", test::rhino(), clock);
    EXPECT_EQ(cell.transcript(), nullptr);
    const LineId line = cell.apply(LineOpened{"test"}, 0).line;
    EXPECT_EQ(cell.apply(BytesIn{line, "E?"}, 0).bytes_taken, 2U);
    EXPECT_EQ(cell.clock_remainder(), 0);
  }
}

TEST(ByteClockCell, StopsBetweenCommandsWhenItIsEnough) {
  ByteLab lab;
  const LineId line = lab.open();
  int asked = 0;
  const std::size_t taken =
      lab.cell.apply(BytesIn{line, "E?E?E?E?"}, 0, [&asked] { return ++asked == 2; }).bytes_taken;
  EXPECT_EQ(taken, 4U);
}

// --- The property.

/// What a run of one program tells: the replies, and the transcript, which has their ticks.
struct Run {
  std::string replies;
  std::string digest;
};

/// Sends `program` in pieces of these sizes; the wall clock advances as much between them.
Run run_in_pieces(const std::string& program, const std::vector<std::size_t>& sizes) {
  ByteLab lab;
  Fault delay = fault_of(FaultKind::kReplyDelayed);
  delay.delay_ms = 40;
  delay.chance = kCertain / 10;
  lab.cell.set_faults({7, {delay}});
  const LineId line = lab.open();
  Run run;
  std::size_t at = 0;
  for (std::size_t piece = 0; at < program.size(); ++piece) {
    const std::size_t size = sizes.empty() ? program.size() : sizes[piece % sizes.size()] + 1;
    lab.wall += static_cast<WallNs>(size) * 10'000'000;
    at += lab.send(line, std::string_view(program).substr(at, size));
    run.replies += lab.take(line);
    if (sizes.size() % 2 == 1) lab.cell.catch_up(lab.wall);
  }
  lab.close(line);
  run.digest = lab.digest();
  return run;
}

RC_GTEST_PROP(ByteClockCell, TheSameBytesInAnyPiecesGiveTheSameRun, ()) {
  const auto command = rc::gen::element<std::string>(
      "E+50\r", "E-20\r", "E?", "I", "J", "D+9", "E?", "F-30\r", "FX", "A+40\r", "?", "T", "A*5,5*",
      "A*3*", "A$", "\xff\xfd\x03", "\xff\xff", "x", "P", "P3", "OL", "E*60\r", "C?", "A@", "A@");
  std::string program;
  for (const std::string& each : *rc::gen::container<std::vector<std::string>>(command))
    program += each;
  const auto sizes =
      *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, 9));
  const Run whole = run_in_pieces(program, {});
  const Run pieces = run_in_pieces(program, sizes);
  RC_ASSERT(whole.replies == pieces.replies);
  RC_ASSERT(whole.digest == pieces.digest);
}

}  // namespace
}  // namespace xr3
