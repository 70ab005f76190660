// The time to repeat a recording: an hour of ordinary polling, 50 inquiries a second, of a robot
// that keeps moving.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "tests/support/models.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

constexpr WallNs kPollNs = 20'000'000;
constexpr int kPollsInAnHour = 3600 * 50;
constexpr int kPollsInAMove = 100;

struct RecordedHour {
  std::string text;
  std::string hash;
};

RecordedHour recorded_hour() {
  const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  test::RecordedCell recorded(model);
  Cell& cell = recorded.cell;
  cell.apply(LineOpened{"127.0.0.1:50000"}, 0);
  constexpr std::array<std::string_view, 6> kInquiries = {"A?", "B?", "C?", "D?", "E?", "F?"};
  for (int i = 0; i < kPollsInAnHour; ++i) {
    const WallNs now = kPollNs * (i + 1);
    if (i % kPollsInAMove == 0)
      cell.apply(BytesIn{1, i % (2 * kPollsInAMove) == 0 ? "E+60\rC-20\r" : "E-60\rC+20\r"}, now);
    cell.apply(BytesIn{1, kInquiries[static_cast<std::size_t>(i) % kInquiries.size()]}, now);
    cell.sent({1, cell.find_line(1)->outbox().size()});
  }
  return {recorded.text(), StateHasher().hash(cell)};
}

void replay_of_an_hour(benchmark::State& state) {
  static const RecordedHour hour = recorded_hour();
  for (auto _ : state) {
    const test::Replayed replayed = test::replay(hour.text);
    if (replayed.difference || replayed.hash != hour.hash) state.SkipWithError("another state");
  }
  state.counters["bytes_a_poll"] =
      static_cast<double>(hour.text.size()) / static_cast<double>(kPollsInAnHour);
}

BENCHMARK(replay_of_an_hour)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace xr3
