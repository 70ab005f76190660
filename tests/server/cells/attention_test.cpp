#include "server/cells/attention.hpp"

#include <gtest/gtest.h>

#include "server/net/wall_clock.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using monitor::CellSummary;

class AttentionTest : public testing::Test {
 protected:
  AttentionTest() { cell_.apply(LineOpened{"test"}, 0); }
  void send(std::string_view bytes) { cell_.apply(BytesIn{1, bytes}, 0); }
  CellSummary summary() const {
    CellSummary summary;
    attention_.describe(summary);
    return summary;
  }

  Cell cell_{"main",
             std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                           test::workcell_named("rhino-xr3"), Profile::kPaper),
             SimClock::manual()};
  Attention attention_{cell_};
};

TEST_F(AttentionTest, NothingHasHappenedAtFirst) {
  EXPECT_FALSE(summary().last_input_at);
  EXPECT_FALSE(summary().last_command);
  EXPECT_FALSE(summary().last_warning);
}

TEST_F(AttentionTest, ShowsTheLastCommandAsItWasSent) {
  const std::int64_t before = unix_ms();
  send("E?F+");
  EXPECT_EQ(summary().last_command, (monitor::CommandSummary{"E?", 1, true}));
  EXPECT_GE(*summary().last_input_at, before);
  send("50\r");
  EXPECT_EQ(summary().last_command, (monitor::CommandSummary{"F+50", 1, false}));
}

TEST_F(AttentionTest, CountsEqualCommandsInARow) {
  for (int i = 0; i < 31; ++i) send("E?");
  EXPECT_EQ(summary().last_command, (monitor::CommandSummary{"E?", 31, true}));
  send("F?");
  EXPECT_EQ(summary().last_command->count, 1U);
}

TEST_F(AttentionTest, CountsWarningsWithTheSameCode) {
  send("%");
  send("&");
  ASSERT_TRUE(summary().last_warning);
  EXPECT_EQ(summary().last_warning->count, 2U);
  EXPECT_FALSE(summary().last_warning->text.empty());
}

TEST_F(AttentionTest, AResetBeginsAnew) {
  send("%E+5\r");
  cell_.apply(Input{call::Call{call::Reset{}}}, 0);
  EXPECT_FALSE(summary().last_command);
  EXPECT_FALSE(summary().last_warning);
  EXPECT_TRUE(summary().last_input_at);
}

TEST_F(AttentionTest, AStallHasItsTimeUntilItIsCleared) {
  EXPECT_FALSE(summary().stalled_at);
  for (int i = 0; i < 6; ++i) {
    send("E-100\r");
    cell_.apply(Input{call::Call{call::RunUntil{std::nullopt, 20'000}}}, 0);
  }
  ASSERT_NE(cell_.state().stall, Stall::kNo);
  EXPECT_TRUE(summary().stalled_at);
  cell_.apply(Input{call::Call{call::Home{}}}, 0);
  EXPECT_FALSE(summary().stalled_at);
}

}  // namespace
}  // namespace xr3
