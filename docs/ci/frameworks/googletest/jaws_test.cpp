#include "jaws.hpp"

#include <gtest/gtest.h>

namespace {

/// The robot that `xr3 exec` has started for this test alone.
class Jaws : public testing::Test {
 protected:
  Robot robot{0, nullptr};
};

TEST_F(Jaws, HoldNothingInTheAir) { EXPECT_EQ(close_jaws(robot), 0); }

TEST_F(Jaws, HoldTheBlock) {
  robot.go({{'A', -16}});
  robot.go({{'E', 449}, {'D', -625}});
  EXPECT_NEAR(close_jaws(robot), 32, 1);
}

}  // namespace
