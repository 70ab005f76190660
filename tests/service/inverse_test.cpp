// The call `inverse`: counts for a place of the tool, or the reason why it cannot be there.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/cell_monitor_fixture.hpp"

namespace xr3 {
namespace {

class InverseTest : public test::CellMonitorFixture {
 protected:
  Json inverse(const std::string& args) { return call("inverse", args); }
};

TEST_F(InverseTest, FindsCountsAndMovesNothing) {
  const Json value = inverse(R"({"xyz_mm":[262,0,120],"pitch_deg":-90,"roll_deg":90})")["value"];
  EXPECT_EQ(value["counts"], Json::parse(R"({"F":0,"E":242,"D":-440,"C":0,"B":0,"A":0})"));
  EXPECT_EQ(value["branch"], "front, elbow up");
  EXPECT_NEAR(value["xyz_mm"][2], 120, 1);
  EXPECT_EQ(value["tick"], 0);
  EXPECT_EQ(cell_->state().motor(1).count, 0);
}

TEST_F(InverseTest, WhatIsOmittedStaysAsItIsNear) {
  const Json value =
      inverse(R"({"xyz_mm":[262,0,60],"near":{"E":242,"D":-440,"B":100,"A":-7}})")["value"];
  EXPECT_EQ(value["counts"]["A"], -7) << "the jaws";
  EXPECT_EQ(value["counts"]["B"], 100) << "the roll";
  EXPECT_NEAR(value["xyz_mm"][2], 60, 1);
}

TEST_F(InverseTest, SaysWhyTheToolCannotBeThere) {
  const Json error = inverse(R"({"xyz_mm":[262,0,-18],"near":{"E":242,"D":-440}})")["error"];
  EXPECT_EQ(error["code"], "unreachable");
  EXPECT_EQ(error["cause"], "work_surface");
  EXPECT_NEAR(error["amount"], 18, 1);
  EXPECT_EQ(error["message"].get<std::string>().find("mm below the table") != std::string::npos,
            true)
      << error["message"];
  EXPECT_NEAR(error["nearest"]["xyz_mm"][2], 0, 1.5);
  const Json far = inverse(R"({"xyz_mm":[900,0,120],"pitch_deg":-90})")["error"];
  EXPECT_EQ(far["cause"], "too_far");
  const Json bent =
      inverse(R"({"xyz_mm":[262,0,120],"pitch_deg":90,"near":{"E":242,"D":-440}})")["error"];
  EXPECT_EQ(bent["cause"], "limit");
  EXPECT_TRUE(bent["joint"].is_string());
}

TEST_F(InverseTest, NamesAJointThatTheRobotDoesNotHave) {
  const Json error = inverse(R"({"xyz_mm":[262,0,120],"near":{"H":1}})")["error"];
  EXPECT_EQ(error["code"], "no_such_joint");
  EXPECT_EQ(error["hint"], "its labels are ABCDEF");
}

}  // namespace
}  // namespace xr3
