#include "cell/recording/state_hash.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

/// The digest after bytes on a line of a cell with the manual clock.
std::string hash_after(std::string_view bytes, std::size_t sent = 0) {
  Cell cell("main", test::rhino(), SimClock::manual());
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, bytes}, 0);
  cell.sent({1, sent});
  return StateHasher().hash(cell);
}

TEST(StateHash, DependsOnMachineParserAndFilters) {
  const std::string rest = hash_after("E?");
  EXPECT_EQ(rest, hash_after("E?"));
  EXPECT_NE(rest, hash_after("E?E+1\r")) << "the machine";
  EXPECT_NE(rest, hash_after("D?")) << "the parser's selected joint";
  EXPECT_NE(hash_after("E?E"), hash_after("E?D"));
  EXPECT_NE(hash_after("G"), hash_after("P")) << "bytes that the detector holds";
  EXPECT_NE(hash_after("E?\xff"), hash_after("E?\xfe")) << "the telnet filter";
}

TEST(StateHash, DoesNotDependOnWhatTheTransportHasSent) {
  EXPECT_EQ(hash_after("E?", 0), hash_after("E?", 1));
}

TEST(StateHash, DependsOnTheModelAndTheClocksRemainder) {
  Cell cell("main", test::rhino(), SimClock::manual());
  Cell other("main", test::roomy_rhino(), SimClock::manual(), {});
  StateHasher hasher;
  EXPECT_NE(hasher.hash(cell), hasher.hash(other));
  EXPECT_EQ(hasher.hash(cell), StateHasher().hash(cell));
  Cell timed("main", test::rhino(), SimClock::bytes(), {});
  timed.set_byte_clock({});
  const std::string before = hasher.hash(timed);
  timed.set_clock_remainder(1);
  EXPECT_NE(hasher.hash(timed), before);
}

}  // namespace
}  // namespace xr3
