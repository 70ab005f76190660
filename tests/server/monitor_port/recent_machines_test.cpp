// Which machines count as recent: for a minute, and the latest of too many.
#include "server/monitor_port/recent_machines.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

using namespace std::chrono_literals;

asio::ip::address machine(unsigned number) { return asio::ip::address_v4(number); }

class RecentMachinesTest : public testing::Test {
 protected:
  RecentMachines machines_;
  RecentMachines::Time now_{1h};
};

TEST_F(RecentMachinesTest, RemembersAMachineForAMinuteAfterTheLastNote) {
  machines_.note(machine(1), now_);
  machines_.note(machine(1), now_ + 30s);
  EXPECT_TRUE(machines_.contains(machine(1), now_ + 89s));
  EXPECT_FALSE(machines_.contains(machine(1), now_ + 90s));
  EXPECT_FALSE(machines_.contains(machine(2), now_));
}

TEST_F(RecentMachinesTest, ForgetsTheOldestOfTooMany) {
  for (unsigned i = 1; i <= RecentMachines::kMost; ++i) machines_.note(machine(i), now_ + i * 1us);
  machines_.note(machine(1), now_ + 1s);
  machines_.note(machine(1000), now_ + 1s);
  EXPECT_TRUE(machines_.contains(machine(1), now_ + 1s));
  EXPECT_FALSE(machines_.contains(machine(2), now_ + 1s));
  EXPECT_TRUE(machines_.contains(machine(3), now_ + 1s));
  EXPECT_TRUE(machines_.contains(machine(1000), now_ + 1s));
}

}  // namespace
}  // namespace xr3
