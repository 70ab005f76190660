#include "cell/agenda.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace xr3 {
namespace {

using enum Direction;

TEST(Agenda, OrdersByMomentThenLineThenDirection) {
  Agenda agenda;
  agenda.set(2, kIn, 100);
  agenda.set(1, kOut, 100);
  agenda.set(1, kIn, 100);
  agenda.set(3, kIn, 99);
  std::vector<Due> order;
  while (!agenda.empty()) {
    order.push_back(agenda.first());
    agenda.set(order.back().line, order.back().direction, std::nullopt);
  }
  EXPECT_EQ(order, (std::vector<Due>{{99, 3, kIn}, {100, 1, kIn}, {100, 1, kOut}, {100, 2, kIn}}));
}

TEST(Agenda, ForgetsALine) {
  Agenda agenda;
  agenda.set(1, kIn, 5);
  agenda.set(1, kOut, 6);
  agenda.set(2, kOut, 7);
  agenda.forget(1);
  EXPECT_EQ(agenda.first(), (Due{7, 2, kOut}));
}

struct AgendaChange {
  LineId line;
  Direction direction;
  std::optional<Micros> at;
};

// Whatever is set, the first entry is the least of those that were set last.
RC_GTEST_PROP(Agenda, KeepsTheLatestEntryOfEachDirection, ()) {
  Agenda agenda;
  std::map<std::pair<LineId, Direction>, Micros> expected;
  const int count = *rc::gen::inRange(0, 60);
  for (int i = 0; i < count; ++i) {
    const AgendaChange change{*rc::gen::inRange<LineId>(1, 4), *rc::gen::element(kIn, kOut),
                              *rc::gen::inRange<Micros>(0, 5)};
    const bool is_removal = *rc::gen::arbitrary<bool>();
    agenda.set(change.line, change.direction, is_removal ? std::nullopt : change.at);
    if (is_removal) {
      expected.erase({change.line, change.direction});
    } else {
      expected[{change.line, change.direction}] = *change.at;
    }
    std::vector<Due> all;
    for (const auto& [key, at] : expected) all.push_back({at, key.first, key.second});
    RC_ASSERT(agenda.empty() == all.empty());
    if (!all.empty()) RC_ASSERT(agenda.first() == *std::min_element(all.begin(), all.end()));
  }
}

}  // namespace
}  // namespace xr3
