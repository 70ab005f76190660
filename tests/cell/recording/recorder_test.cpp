#include "cell/recording/recorder.hpp"

#include <gtest/gtest.h>

#include "protocol/recording/entry_json.hpp"
#include "tests/support/models.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

using test::RecordedCell;

constexpr WallNs kRecorderMs = 1'000'000;

/// The members of all entries.
std::vector<std::string> lines_of(const RecordedCell& recorded) {
  std::vector<std::string> lines;
  for (const recording::Entry& entry : recorded.entries())
    lines.push_back(recording::members_of(entry, 0) + "}");
  return lines;
}

using Lines = std::vector<std::string>;

void ask(Cell& cell, std::string_view bytes, WallNs now) {
  cell.apply(BytesIn{1, bytes}, now);
  cell.sent({1, cell.find_line(1)->outbox().size()});
}

TEST(Recorder, APollIsOneShortLine) {
  RecordedCell recorded(test::rhino());
  recorded.cell.apply(LineOpened{"127.0.0.1:5000"}, 0);
  ask(recorded.cell, "A?", 20 * kRecorderMs);
  ask(recorded.cell, "A?", 40 * kRecorderMs);
  EXPECT_EQ(lines_of(recorded),
            (Lines{R"({"tick":0,"line":1,"open":"tcp","peer":"127.0.0.1:5000","guard":"normal"})",
                   R"({"tick":20,"line":1,"in":"A?","out":" "})",
                   R"({"tick":40,"line":1,"in":"A?","out":" "})"}));
}

TEST(Recorder, ClosedLinesAndRefusedCallsAreNotRecorded) {
  RecordedCell recorded(test::rhino());
  Cell& cell = recorded.cell;
  cell.apply(BytesIn{7, "A?"}, 0);
  cell.sent({7, 1});
  cell.apply(LineClosed{7, LineCloseReason::kClientClosed}, 0);
  cell.apply(Input{call::Call{call::Step{5}}}, 0);
  EXPECT_EQ(lines_of(recorded), Lines{});
}

TEST(Recorder, TheStateIsHashedWithTheFirstInputAfterTenSeconds) {
  RecordedCell recorded(test::rhino());
  Cell& cell = recorded.cell;
  cell.apply(LineOpened{"test"}, 0);
  cell.catch_up(25'000 * kRecorderMs);
  EXPECT_EQ(recorded.entries().size(), 1U);
  ask(cell, "A?", 26'000 * kRecorderMs);
  ask(cell, "A?", 27'000 * kRecorderMs);
  ask(cell, "A?", 30'000 * kRecorderMs);
  std::vector<Tick> ticks;
  for (const auto& entry : recorded.entries()) {
    if (std::holds_alternative<recording::StateHash>(entry.body)) ticks.push_back(entry.tick);
  }
  EXPECT_EQ(ticks, (std::vector<Tick>{26'000, 30'000}));
}

TEST(Recorder, UnsentRepliesAndCutReadsAreTold) {
  RecordedCell recorded(test::rhino());
  Cell& cell = recorded.cell;
  cell.apply(LineOpened{"test", LineKind::kPty}, 0);
  cell.apply(BytesIn{1, "A?A?"}, 0);
  cell.sent({1, 1});
  cell.apply(BytesIn{1, "A?"}, 0);
  cell.apply(BytesIn{1, std::string(100, '?')}, 0, [] { return true; });
  const auto& last = std::get<recording::LineInput>(recorded.entries().back().body);
  EXPECT_EQ(last.bytes, std::string(64, '?'));
  EXPECT_EQ(last.unsent, 2U);
  EXPECT_EQ(lines_of(recorded)[2], R"({"tick":0,"line":1,"in":"A?","unsent":1,"out":" "})");
}

TEST(Recorder, AClientThatIsRefusedIsRecordedWithAllItsFirstBytes) {
  RecordedCell recorded(test::rhino());
  recorded.cell.apply(LineOpened{"test"}, 0);
  const std::string request = "GET / HTTP/1.1\r\nHost: a\r\n\r\n";
  recorded.cell.apply(BytesIn{1, request}, 0);
  const auto& input = std::get<recording::LineInput>(recorded.entries().back().body);
  EXPECT_EQ(input.bytes, request);
  EXPECT_LT(input.taken, request.size());
}

TEST(Recorder, PacedRepliesHaveTicksOfTheirOwn) {
  RecordedCell recorded(test::rhino(),
                        {SimClock::real({}, 0), LineSpeed{parse_serial_settings("9600-7e2"), {}}});
  recorded.cell.apply(LineOpened{"test"}, 0);
  recorded.cell.apply(BytesIn{1, "A?"}, 0);
  recorded.cell.catch_up(100 * kRecorderMs);
  EXPECT_EQ(lines_of(recorded).back(), R"({"tick":4,"line":1,"out":" "})");
}

TEST(Recorder, TheHeaderSaysWhatTheCellIsMadeOf) {
  RecordedCell recorded(test::rhino(Profile::kMark3),
                        {SimClock::manual(), LineSpeed{std::nullopt, {2'000'000}}});
  const recording::Header header = recording_header(recorded.cell, "xr3 9");
  EXPECT_EQ(header.model->profile(), Profile::kMark3);
  EXPECT_EQ(header.mode, ClockMode::kManual);
  EXPECT_EQ(header.line_speed->factor, Rate{2'000'000});
  EXPECT_EQ(header.state_format, kStateFormat);
  EXPECT_FALSE(header.faults || header.device);
}

}  // namespace
}  // namespace xr3
