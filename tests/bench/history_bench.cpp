// The processor time to make a moment of the past again: anywhere in an hour in which the robot
// keeps moving and is asked 50 times a second.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <random>

#include "cell/history/past.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr WallNs kAskNs = 20'000'000;
constexpr int kAsksInAnHour = 3600 * 50;
constexpr int kAsksInAMotion = 100;
constexpr int kMoments = 200;
constexpr std::size_t kHistoryBudget = std::size_t{64} << 20U;

/// A cell with an hour of history.
struct MovingHour {
  MovingHour() {
    cell.apply(LineOpened{"127.0.0.1:50000"}, 0);
    constexpr std::array<std::string_view, 6> kInquiries = {"A?", "B?", "C?", "D?", "E?", "F?"};
    for (int i = 0; i < kAsksInAnHour; ++i) {
      const WallNs now = kAskNs * (i + 1);
      if (i % kAsksInAMotion == 0)
        cell.apply(BytesIn{1, i % (2 * kAsksInAMotion) == 0 ? "E+60\rC-20\r" : "E-60\rC+20\r"},
                   now);
      cell.apply(BytesIn{1, kInquiries[static_cast<std::size_t>(i) % kInquiries.size()]}, now);
      cell.sent({1, cell.find_line(1)->outbox().size()});
    }
  }

  monitor::ByteBudget budget{kHistoryBudget};
  Cell cell{"main",
            std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                          test::workcell_named("rhino-xr3"), Profile::kPaper),
            SimClock::real({}, 0)};
  History history{cell, 3'600'000, budget};
};

void moment_of_an_hour(benchmark::State& state) {
  static const MovingHour hour;
  std::mt19937 random(1);
  double worst_ms = 0;
  for (auto _ : state) {
    for (int i = 0; i < kMoments; ++i) {
      const ReplayTime time{0, static_cast<Tick>(random() % 3'600'000)};
      const std::clock_t begin = std::clock();
      const Past past =
          make_past(recording_header(hour.cell, ""), *hour.history.part_before(time), time);
      worst_ms =
          std::max(worst_ms, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      if (past.difference || past.cell->state().tick != time.tick)
        state.SkipWithError("another moment");
    }
  }
  state.counters["worst_ms"] = worst_ms;
  state.counters["history_KiB"] = static_cast<double>(hour.history.used_bytes()) / 1024;
}

BENCHMARK(moment_of_an_hour)->Unit(benchmark::kMillisecond)->Iterations(1);

/// An inquiry with and without a history.
void inquiry_with_history(benchmark::State& state) {
  monitor::ByteBudget budget(kHistoryBudget);
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  std::optional<History> history;
  if (state.range(0) != 0) history.emplace(cell, 3'600'000, budget);
  cell.apply(LineOpened{"127.0.0.1:50000"}, 0);
  WallNs now = 0;
  for (auto _ : state) {
    now += 1'000'000;
    cell.apply(BytesIn{1, "E?"}, now);
    cell.sent({1, 1});
  }
}

BENCHMARK(inquiry_with_history)->Arg(0)->Arg(1);

}  // namespace
}  // namespace xr3
