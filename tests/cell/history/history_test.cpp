#include "cell/history/history.hpp"

#include <gtest/gtest.h>

#include "cell/history/heap_size.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr WallNs kHistoryMs = 1'000'000;
constexpr std::size_t kAmple = std::size_t{64} << 20U;

/// A cell with a history and a line.
struct Kept {
  explicit Kept(Tick longest = 3'600'000, std::size_t budget_bytes = kAmple)
      : budget(budget_bytes),
        cell("main", test::rhino(), SimClock::real({}, 0)),
        history(cell, longest, budget) {
    cell.apply(LineOpened{"test"}, 0);
  }
  /// Sends bytes at a millisecond.
  void send(int ms, std::string_view bytes) {
    cell.apply(BytesIn{1, bytes}, ms * kHistoryMs);
    cell.sent({1, cell.find_line(1)->outbox().size()});
  }
  void call(int ms, call::Call call) { cell.apply(Input{std::move(call)}, ms * kHistoryMs); }
  /// Takes the cell back to a time of which only the tick matters here.
  void rewind(int ms, const ReplayTime& time) {
    State state = cell.state();
    state.tick = time.tick;
    auto past = std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), state});
    cell.apply(Rewind{past, time}, ms * kHistoryMs);
  }
  /// The epochs as `epoch:from-to`.
  std::string spans() const {
    std::string text;
    for (const EpochSpan& span : history.epochs())
      text += (text.empty() ? "" : " ") + std::to_string(span.epoch) + ":" +
              std::to_string(span.from) + "-" + std::to_string(span.to);
    return text;
  }

  monitor::ByteBudget budget;
  Cell cell;
  History history;
};

TEST(History, BeginsWithTheFirstInput) {
  monitor::ByteBudget budget(kAmple);
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  const History history(cell, 1000, budget);
  cell.catch_up(500 * kHistoryMs);
  EXPECT_TRUE(history.epochs().empty());
  EXPECT_EQ(budget.used_bytes(), 0U);
  EXPECT_EQ(history.part_before({0, 0}), nullptr);
  cell.apply(LineOpened{"test"}, 700 * kHistoryMs);
  cell.catch_up(900 * kHistoryMs);
  EXPECT_FALSE(history.covers({0, 699}));
  EXPECT_TRUE(history.covers({0, 700}));
  EXPECT_TRUE(history.covers({0, 900}));
  EXPECT_FALSE(history.covers({0, 901}));
  EXPECT_FALSE(history.covers({1, 800}));
}

TEST(History, ACheckpointComesAfterMotionOrManyInputs) {
  Kept kept;
  for (int ms = 1; ms < 60'000; ms += 100) kept.send(ms, "E?");
  EXPECT_EQ(kept.history.parts(), 1U) << "nothing moves";
  for (int ms = 60'000; ms < 120'000; ms += 1000)
    kept.send(ms, ms % 2000 == 0 ? "E+99\r" : "E-99\r");
  EXPECT_GE(kept.history.parts(), 5U);
  EXPECT_LE(kept.history.parts(), 7U);
  const std::size_t before = kept.history.parts();
  for (int i = 0; i < 10'000; ++i) kept.send(130'000, "E?");
  EXPECT_EQ(kept.history.parts(), before + 3) << "one for the motion, two for the inputs";
}

TEST(History, UnchangedBlocksAreShared) {
  Kept kept;
  for (int ms = 1; ms < 60'000; ms += 500) kept.send(ms, ms % 1000 == 1 ? "E+99\r" : "E-99\r");
  const HistoryPartPtr first = kept.history.part_before({0, 0});
  const HistoryPartPtr last = kept.history.part_before({0, kept.cell.state().tick});
  ASSERT_NE(first->from(), last->from());
  EXPECT_TRUE(
      first->start.machine.state().blocks.is_shared_with(last->start.machine.state().blocks));
  EXPECT_TRUE(first->start.machine.state().blocks.is_shared_with(kept.cell.state().blocks));
}

TEST(History, TheLongestTimeIsKept) {
  Kept kept(30'000);
  for (int ms = 1; ms <= 200'001; ms += 500) kept.send(ms, ms % 1000 == 1 ? "E+99\r" : "E-99\r");
  const auto spans = kept.history.epochs();
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_LE(spans[0].from, 170'001) << "all of the wanted time";
  EXPECT_GE(spans[0].from, 150'001) << "and not much more";
}

TEST(History, EpochsFollowEachOther) {
  Kept kept;
  kept.send(100, "E+9\r");
  kept.call(500, call::Reset{});
  kept.send(800, "E+9\r");
  kept.call(900, call::Reset{});
  kept.cell.catch_up(1000 * kHistoryMs);
  EXPECT_EQ(kept.spans(), "0:0-500 1:0-400 2:0-100");
  EXPECT_EQ(kept.history.part_before({1, 399})->from(), (ReplayTime{1, 300}));
  EXPECT_EQ(kept.history.part_before({1, 299})->from(), (ReplayTime{0, 0}));
}

TEST(History, TheFutureIsKeptUntilResume) {
  Kept kept;
  kept.send(100, "E+9\r");
  kept.send(600, "E-9\r");
  kept.rewind(1000, {0, 200});
  EXPECT_EQ(kept.spans(), "0:0-1000 1:200-200");
  kept.rewind(1500, {0, 900});
  EXPECT_EQ(kept.spans(), "0:0-1000 2:900-900");
  kept.rewind(1500, {2, 900});
  EXPECT_EQ(kept.spans(), "0:0-1000 3:900-900") << "where it is already";
  kept.rewind(1600, {0, 300});
  kept.call(2000, call::Resume{});
  kept.cell.catch_up(2100 * kHistoryMs);
  EXPECT_EQ(kept.spans(), "0:0-300 4:300-400");
  const HistoryPartPtr part = kept.history.part_before({0, 300});
  std::size_t inputs = 0;
  part->inputs.for_each([&](const recording::Entry& entry) {
    EXPECT_LE(entry.tick, 300);
    return ++inputs, true;
  });
  EXPECT_EQ(inputs, 2U) << "the line and its first bytes";
}

TEST(History, APartThatWasGivenDoesNotChange) {
  Kept kept;
  kept.send(100, "E+9\r");
  kept.call(500, call::Reset{});
  const HistoryPartPtr last = kept.history.part_before({0, 400});
  EXPECT_EQ(last->inputs.size(), 3U);
  kept.send(600, "E+9\r");
  EXPECT_EQ(last->inputs.size(), 3U) << "a copy of the part that still grew";
  const HistoryPartPtr first = kept.history.part_before({0, 400});
  kept.rewind(700, {0, 200});
  kept.call(800, call::Resume{});
  kept.send(900, "E?");
  EXPECT_EQ(first->inputs.size(), 3U) << "the future was dropped";
  EXPECT_EQ(kept.history.part_before({0, 200})->inputs.size(), 2U);
}

TEST(History, BeginsAnewAfterLongQueues) {
  monitor::ByteBudget budget(kAmple);
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  cell.set_line_speed({parse_serial_settings("300-8n1"), {}});
  const History history(cell, 3'600'000, budget);
  const LineId monitor = cell.apply(LineOpened{"monitor", LineKind::kMonitor}, 0).line;
  EXPECT_TRUE(history.covers({0, 0}));
  std::vector<LineId> full;
  constexpr std::size_t kQueue = LinePace::kMaxInput * sizeof(ReceivedByte);
  for (std::size_t waiting = 0; waiting <= History::kMaxQueues; waiting += kQueue) {
    full.push_back(cell.apply(LineOpened{"test", LineKind::kPty}, 0).line);
    cell.apply(BytesIn{full.back(), std::string(LinePace::kMaxInput, 'x')}, 0);
  }
  const auto poll = [&](int ms, std::size_t inputs) {
    for (std::size_t i = 0; i < inputs; ++i) cell.apply(BytesIn{monitor, "E?"}, ms * kHistoryMs);
    cell.sent({monitor, inputs});
  };
  poll(1, History::kInputs + 1);
  EXPECT_TRUE(history.epochs().empty());
  EXPECT_EQ(history.used_bytes(), 0U);
  for (const LineId line : full)
    cell.apply(LineClosed{line, LineCloseReason::kError}, 2 * kHistoryMs);
  poll(3, History::kRetryInputs + 1);
  EXPECT_TRUE(history.covers({0, 3}));
  EXPECT_FALSE(history.covers({0, 1}));
  EXPECT_EQ(history.epochs().size(), 1U) << "no gap";
}

TEST(History, TheNumberOfPartsIsLimited) {
  Kept kept;
  for (int ms = 1; ms <= 3 * static_cast<int>(History::kMaxParts); ++ms)
    kept.call(ms, call::Reset{});
  EXPECT_LE(kept.history.parts(), History::kMaxParts);
  EXPECT_TRUE(kept.history.covers({kept.cell.epoch(), kept.cell.state().tick}));
  EXPECT_FALSE(kept.history.covers({0, 0}));
  EXPECT_EQ(kept.history.part_before({kept.cell.epoch() - 5, 0})->from().epoch,
            kept.cell.epoch() - 6)
      << "a part begins with the input after the call";
}

TEST(History, TriesRarelyIfOnePartIsTooMuch) {
  monitor::ByteBudget budget(100);
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  const History history(cell, 3'600'000, budget);
  cell.apply(LineOpened{"test"}, 0);
  for (int ms = 1; ms < 5000; ++ms) cell.apply(BytesIn{1, "E?"}, ms * kHistoryMs);
  EXPECT_EQ(history.parts(), 0U);
  EXPECT_EQ(history.used_bytes(), 0U);
  EXPECT_TRUE(history.epochs().empty());
}

TEST(History, StaysInItsBudget) {
  constexpr std::size_t kSmall = 200'000;
  Kept kept(3'600'000'000, kSmall);
  for (int ms = 1; ms < 900'000; ms += 20) kept.send(ms, ms % 40 == 1 ? "E+1\r" : "E-1\r?");
  EXPECT_LE(kept.history.used_bytes(), kSmall);
  EXPECT_LE(kept.budget.used_bytes(), kSmall);
  EXPECT_GT(kept.history.used_bytes(), kSmall / 4);
  const auto spans = kept.history.epochs();
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_GT(spans[0].from, 0);
  EXPECT_LT(spans[0].from, 890'000);
}

TEST(History, CountsTheModelsThatOnlyItKeeps) {
  Kept kept(3'600'000'000, kAmple);
  const Workcell workcell = kept.cell.model().workcell();
  kept.call(1, call::Reset{});
  const std::size_t before = kept.history.used_bytes();
  constexpr int kTimes = 10;
  for (int ms = 2; ms < 2 + kTimes; ++ms) {
    kept.call(ms, call::ReplaceWorkcell{workcell});
    kept.call(ms, call::Reset{});
  }
  EXPECT_GE(kept.history.used_bytes() - before, (kTimes - 1) * heap_of(kept.cell.model()));
}

TEST(History, CountsTheSnapshotsThatOnlyItKeeps) {
  Kept kept(3'600'000'000, kAmple);
  kept.call(1, call::Reset{});
  const auto grown = [&kept](int ms, const call::Call& call) {
    const std::size_t before = kept.history.used_bytes();
    for (int turn = 0; turn < 10; ++turn) {
      kept.call(ms + turn, call);
      kept.call(ms + turn, call::Reset{});
    }
    return kept.history.used_bytes() - before;
  };
  const std::size_t without = grown(2, call::Home{});
  // Ten are saved: the cell itself keeps the last one, and a part begins after the first one.
  EXPECT_GE(grown(20, call::SaveSnapshot{"a"}), without + 8 * sizeof(MachineSnapshot));
}

TEST(History, GivesBackWhatItHasCounted) {
  Kept kept(3'600'000'000, kAmple);
  for (int ms = 1; ms < 600; ++ms) {
    kept.call(ms, call::ReplaceWorkcell{kept.cell.model().workcell()});
    kept.call(ms, call::SaveSnapshot{std::to_string(ms % 3)});
    kept.call(ms, call::Reset{});
  }
  EXPECT_LE(kept.history.used_bytes(), kAmple);
  for (int ms = 600; ms < 3600; ++ms) kept.call(ms, call::Reset{});
  EXPECT_LT(kept.history.used_bytes(), 3600 * 2 * sizeof(HistoryPart));
}

TEST(History, CellsShareTheBudget) {
  constexpr std::size_t kSmall = 400'000;
  monitor::ByteBudget budget(kSmall);
  Cell busy("busy", test::rhino(), SimClock::real({}, 0), {});
  Cell other("other", test::rhino(), SimClock::real({}, 0), {});
  const History of_busy(busy, 3'600'000'000, budget);
  const History of_other(other, 3'600'000'000, budget);
  busy.apply(LineOpened{"test"}, 0);
  for (int ms = 1; ms < 900'000; ms += 10)
    busy.apply(BytesIn{1, ms % 20 == 1 ? "E+1\r" : "E-1\r"}, ms * kHistoryMs);
  other.apply(LineOpened{"test"}, 900'000 * kHistoryMs);
  for (int i = 0; i < 1000; ++i) other.apply(BytesIn{1, "E+1\r"}, (900'000 + i) * kHistoryMs);
  EXPECT_TRUE(of_other.covers({0, 900'000}));
  EXPECT_TRUE(of_busy.covers({0, busy.state().tick}));
  EXPECT_LE(of_busy.used_bytes() + of_other.used_bytes(), kSmall);
}

TEST(History, TheLargestDropsItsOldestCheckpoints) {
  constexpr std::size_t kSmall = 200'000;
  Kept kept(3'600'000'000, kSmall);
  for (int ms = 1; ms < 1'200'000; ms += 500) kept.send(ms, ms % 1000 == 1 ? "E+99\r" : "E-99\r");
  const std::size_t before = kept.history.parts();
  ASSERT_GT(before, 10U);
  ASSERT_GT(kept.budget.used_bytes(), kSmall * 3 / 4);
  struct Other : monitor::ByteBudget::Account {
    std::size_t bytes() const override { return 0; }
    void shrink() override {}
  } other;
  ASSERT_TRUE(kept.budget.grant(other, kSmall / 4));
  EXPECT_LT(kept.history.parts(), before);
  EXPECT_GT(kept.history.parts(), before / 2) << "no more than are needed";
  const auto spans = kept.history.epochs();
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(kept.history.part_before({0, spans[0].from})->from().tick, spans[0].from);
}

TEST(History, AnHourOfMotionFits) {
  Kept kept;
  constexpr int kMoreThanAnHour = 4'000'000;
  for (int ms = 1; ms < kMoreThanAnHour; ms += 1000)
    kept.send(ms, ms % 2000 == 1 ? "E+99\r" : "E-99\r");
  EXPECT_LE(kept.history.parts(), History::kMaxParts);
  const auto spans = kept.history.epochs();
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_LE(spans[0].to - spans[0].from, 3'700'000);
  EXPECT_GE(spans[0].to - spans[0].from, 3'500'000);
}

}  // namespace
}  // namespace xr3
