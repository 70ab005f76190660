// `xr3 kin`: from options to questions; tables, JSON and sentences of the answers.
#include "tools/kin/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/models.hpp"
#include "tools/kin/text.hpp"

namespace xr3 {
namespace {

using test::model_of;
using test::robot_named;
using testing::HasSubstr;
using testing::Not;

const ModelPtr& adept() {
  static const ModelPtr model = model_of(robot_named("adept-one"));
  return model;
}

const ModelPtr& intelledex() {
  static const ModelPtr model = model_of(robot_named("intelledex-660"));
  return model;
}

KinOptionValues counts(std::vector<double> numbers) {
  KinOptionValues values;
  values.counts = std::move(numbers);
  return values;
}

KinOptionValues joints(std::vector<double> numbers) {
  KinOptionValues values;
  values.joints = std::move(numbers);
  return values;
}

KinOptionValues pose(std::vector<double> numbers) {
  KinOptionValues values;
  values.pose = std::move(numbers);
  return values;
}

KinOptionValues configuration(std::vector<double> numbers) {
  KinOptionValues values;
  values.configuration = std::move(numbers);
  return values;
}

KinOptionValues down(std::vector<double> numbers, double net_roll) {
  KinOptionValues values = pose(std::move(numbers));
  values.down = net_roll;
  return values;
}

DirectQuestion direct(const Model& model, const KinOptionValues& values) {
  return std::get<DirectQuestion>(kin_question(model, values));
}

InverseQuestion inverse(const Model& model, const KinOptionValues& values) {
  return std::get<InverseQuestion>(kin_question(model, values));
}

Json solved(const Model& model, const KinOptionValues& values) {
  const InverseQuestion question = inverse(model, values);
  return inverse_json(model, question.target,
                      solve_inverse(model, question.target, question.options));
}

std::string solved_text(const Model& model, const KinOptionValues& values) {
  const InverseQuestion question = inverse(model, values);
  return inverse_text(model, question.target,
                      solve_inverse(model, question.target, question.options));
}

// ---------------------------------------------------------------- questions

TEST(KinQuestion, CountsStartAtTheBase) {
  const DirectQuestion question = direct(*test::rhino(), counts({90, 40, -60, 30, 48}));
  const JointVariables wanted{20.421, -85.46, 92.27, -10.215, -75};
  for (std::size_t k = 0; k < wanted.size(); ++k)
    EXPECT_NEAR(question.variables[k], wanted[k], 1e-9) << k;
  EXPECT_DOUBLE_EQ(question.tool, 50.8);
}

TEST(KinQuestion, TheToolMayFollowTheJoints) {
  EXPECT_DOUBLE_EQ(direct(*test::rhino(), counts({0, 0, 0, 0, 0, 64})).tool, 0);
  EXPECT_DOUBLE_EQ(direct(*test::rhino(), joints({0, -90, 90, 0, -90, 12.5})).tool, 12.5);
  KinOptionValues values = joints({0, -90, 90, 0, -90});
  values.tool = 30;
  EXPECT_DOUBLE_EQ(direct(*test::rhino(), values).tool, 30);
}

TEST(KinQuestion, DownIsAYawAndHalfATurnOfRoll) {
  const ToolTarget by_down = inverse(*test::rhino(), down({262, 0, 20}, 90)).target;
  const ToolTarget by_angles = inverse(*test::rhino(), pose({262, 0, 20, 90, 0, 180})).target;
  EXPECT_EQ(by_down.rotation, by_angles.rotation);
  EXPECT_EQ(by_down.approach(), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(by_down.rotation.col(0), Eigen::Vector3d(0, 1, 0));
}

TEST(KinQuestion, AnApproachWithARollIsAConfiguration) {
  KinOptionValues values = pose({238.1, 0, 320.7});
  values.approach = {0, 0, -2};
  values.roll = -90;
  const ToolTarget pointing = inverse(*test::rhino(), values).target;
  const ToolTarget w =
      inverse(*test::rhino(), configuration({238.1, 0, 320.7, 0, 0, -std::exp(-0.5)})).target;
  EXPECT_EQ(pointing.approach(), w.approach());
  EXPECT_NEAR(pointing.last, w.last, 1e-9);
}

TEST(KinQuestion, YawPitchAndRollRoundTrip) {
  for (const Eigen::Vector3d& ypr : {Eigen::Vector3d(30, 40, -50), Eigen::Vector3d(-170, -80, 179),
                                     Eigen::Vector3d(0, 90, 25), Eigen::Vector3d(0, -90, -25)}) {
    const Eigen::Matrix3d rotation = yaw_pitch_roll_target({0, 0, 0}, ypr).rotation;
    EXPECT_LT((yaw_pitch_roll_deg(rotation) - ypr).norm(), 1e-9) << ypr.transpose();
  }
}

struct Wrong {
  KinOptionValues values;
  const char* says;
};

KinOptionValues with_tool(KinOptionValues values) {
  values.tool = 1;
  return values;
}

KinOptionValues with_roll(KinOptionValues values) {
  values.roll = 1;
  return values;
}

KinOptionValues with_approach(KinOptionValues values, std::vector<double> approach) {
  values.approach = std::move(approach);
  return values;
}

KinOptionValues with_pose(KinOptionValues values) {
  values.pose = {1, 2, 3};
  return values;
}

TEST(KinQuestion, RejectsInvalidQuestionsWithAMessage) {
  const Wrong wrongs[] = {
      {{}, "give one of --joints, --counts, --pose and --configuration"},
      {with_pose(joints({0, 0, 0, 0, 0})), "give one of"},
      {joints({0, 0, 0, 0}),
       "--joints takes 5 numbers for the Rhino XR-3, from the base (F,E,D,C,B)"},
      {counts({0, 0, 0, 0, 0, 0, 0}), "it got 7"},
      {counts({0, 0.5, 0, 0, 0}), "motor counts are whole numbers"},
      {counts({0, 1e9, 0, 0, 0}), "--counts: each number is"},
      {pose({std::numeric_limits<double>::quiet_NaN(), 0, 0}), "--pose: each number is"},
      {pose({1, 2}), "--pose takes x,y,z or x,y,z,yaw,pitch,roll"},
      {pose({1, 2, 3}), "does not give an orientation: add --down"},
      {down({1, 2, 3, 0, 0, 180}, 0), "already gives the orientation"},
      {with_roll(down({1, 2, 3}, 0)), "--down already gives the orientation"},
      {with_approach(pose({1, 2, 3}), {0, 0, 1}), "--approach needs --roll"},
      {with_roll(with_approach(pose({1, 2, 3}), {0, 0, 0})), "not all 0"},
      {with_roll(with_approach(pose({1, 2, 3}), {0, 1})), "--approach takes three numbers"},
      {with_roll(pose({1, 2, 3})), "--approach takes three numbers"},
      {with_roll(joints({0, 0, 0, 0, 0})), "go with --pose"},
      {with_tool(pose({1, 2, 3, 0, 0, 180})), "--tool goes with --joints or --counts"},
      {configuration({1, 2, 3}), "six numbers"},
      {configuration({1, 2, 3, 0, 0, 0}), "cannot all be 0"},
  };
  for (const Wrong& wrong : wrongs) {
    try {
      kin_question(*test::rhino(), wrong.values);
      FAIL() << "taken, but should say: " << wrong.says;
    } catch (const KinQuestionError& error) {
      EXPECT_THAT(error.what(), HasSubstr(wrong.says));
    }
  }
}

TEST(KinQuestion, ThreeJointsAcceptATipWithoutAnApproach) {
  const ModelPtr model = model_of(test::odd_arm(3));
  EXPECT_EQ(inverse(*model, pose({1, 2, 3})).target.kind, TargetKind::kTip);
}

// ---------------------------------------------------------------- direct

TEST(KinReport, DirectTextOfAPose) {
  const std::string text =
      direct_text(*test::rhino(), direct(*test::rhino(), counts({90, 40, -60, 30, 48})));
  EXPECT_THAT(text, HasSubstr("Rhino XR-3: direct kinematics\n"));
  EXPECT_THAT(text, HasSubstr("  D elbow         92.270  deg          -60             -20"));
  EXPECT_THAT(text, HasSubstr("T(3,4) of C tool pitch, and T(0,4)\n"));
  EXPECT_THAT(text, HasSubstr("  0.9954  0.0939   0.0207   92.3095\n"));
  EXPECT_THAT(text, HasSubstr("tip               (247.9346, 92.3095, 293.7373) mm\n"));
  EXPECT_THAT(
      text,
      HasSubstr("configuration w   (247.93462, 92.30951, 293.73731, 0.03669, 0.01366, -0.65808)"));
  EXPECT_THAT(text, HasSubstr("net roll          95.421 deg\n"));
  EXPECT_THAT(text, HasSubstr("at whole counts   0 mm and 0 deg off\n"));
  EXPECT_THAT(text, Not(HasSubstr("-0.0000")));
}

/// Whether the texts are there in this order.
bool are_in_order(const std::string& text, const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    at = text.find(part, at);
    if (at == std::string::npos) return false;
  }
  return true;
}

TEST(KinReport, TheAnswerComesFirst) {
  const std::string tip =
      direct_text(*test::rhino(), direct(*test::rhino(), counts({0, 0, 0, 0, 0})));
  EXPECT_TRUE(
      are_in_order(tip, {"direct kinematics\n\nTool\n  tip ", "\nMotors:", "\nLink matrices"}))
      << tip;
  const std::string pick = solved_text(*test::rhino(), down({262, 0, 20}, 90));
  EXPECT_TRUE(
      are_in_order(pick, {"4 solutions", "\nMotor counts", "\nJoint variables", "\nPositions"}))
      << pick;
}

TEST(KinReport, DirectTextReportsLimitsRegionAndRounding) {
  const std::string text =
      direct_text(*test::rhino(), direct(*test::rhino(), joints({0.1, 12, 160, -150, 0, 70})));
  EXPECT_THAT(text, HasSubstr("past by 18"));  // E: 12 degrees, 10 allowed
  EXPECT_THAT(text, HasSubstr("past by 8"));   // A: 70 mm, 63.5 allowed
  EXPECT_THAT(text, HasSubstr("in the protected region"));
  EXPECT_THAT(text, Not(HasSubstr("   0 mm and 0 deg off")));
}

TEST(KinReport, DirectJsonHasEveryMatrixAndMotor) {
  const Json json = direct_json(*adept(), direct(*adept(), counts({449, 702, 114, -465})));
  ASSERT_EQ(json["motors"].size(), 5u);
  EXPECT_EQ(json["motors"][2]["label"], "C");
  EXPECT_EQ(json["motors"][2]["unit"], "mm");
  EXPECT_EQ(json["motors"][2]["value"], 157.0);
  EXPECT_EQ(json["motors"][2]["count"], 114);
  EXPECT_EQ(json["motors"][4]["name"], "tool");
  ASSERT_EQ(json["links"].size(), 4u);
  EXPECT_EQ(json["links"][2]["previous"][2][3], 157.0);
  EXPECT_EQ(json["links"][3]["base"][0][3], json["tool"]["xyz_mm"][0]);
  EXPECT_NEAR(json["tool"]["xyz_mm"][0].get<double>(), 640.0754, 1e-4);
  EXPECT_NEAR(json["tool"]["configuration"][5].get<double>(), -0.73544, 1e-5);
  EXPECT_EQ(json["tool"]["in_protected_region"], false);
}

// ---------------------------------------------------------------- inverse

TEST(KinReport, InverseTextOfAPick) {
  const std::string text = solved_text(*test::rhino(), down({262, 0, 20}, 90));
  EXPECT_THAT(text, HasSubstr("closed form of a five-axis arm: all solutions"));
  EXPECT_THAT(text, HasSubstr("4 solutions, 1 allowed by limits and protected region"));
  EXPECT_THAT(
      text,
      HasSubstr("1  front, elbow up      0.000     -39.010   109.892       -70.882      -90.000"));
  EXPECT_THAT(text, HasSubstr("1    0   449   -625      0    0   0.281    0.000  allowed\n"));
  EXPECT_THAT(text, HasSubstr("past limits: E 60.84 deg (536), D 85.24 deg (751)\n"));
  EXPECT_THAT(text, HasSubstr("Positions of the joints in counts"));
}

TEST(KinReport, InverseTextWithoutCouplingHasNoPositions) {
  EXPECT_THAT(solved_text(*adept(), down({560, 0, 520}, -90)),
              Not(HasSubstr("Positions of the joints")));
}

TEST(KinReport, InverseTextOfAStretchedArmNamesFreeJoints) {
  const std::string text = solved_text(*intelledex(), configuration({838.2, 0, 373.4, 1, 0, 0}));
  EXPECT_THAT(text, HasSubstr("singular: the hand is in line with wrist and shoulder"));
  EXPECT_THAT(text, HasSubstr("C wrist pitch"));
}

TEST(KinReport, InverseTextNamesTheNumericalMethod) {
  const ModelPtr model = model_of(test::odd_arm(3));
  const std::string text = solved_text(*model, pose({-15, 30, 90}));
  EXPECT_THAT(text, HasSubstr("numerical, because this arm has no closed form here"));
}

TEST(KinReport, RefusalsGiveTheDistance) {
  EXPECT_THAT(solved_text(*test::rhino(), down({500, 0, 92.1}, 0)),
              HasSubstr("No solution: out of reach: the wrist would be 33.3 mm beyond"));
  EXPECT_THAT(solved_text(*test::rhino(), pose({300, 0, 200, 0, 0, 170})),
              HasSubstr("it is 10 degrees out of it"));
  EXPECT_THAT(solved_text(*adept(), pose({560, 0, 520, 0, 5, 180})),
              HasSubstr("the approach is 5 degrees off it"));
}

TEST(KinReport, InverseJsonOfAPick) {
  const Json json = solved(*test::rhino(), down({330, 96, 15}, 25));
  EXPECT_EQ(json["method"], "five_axis_arm");
  EXPECT_EQ(json["refusal"], nullptr);
  EXPECT_EQ(json["free"], Json::array());
  EXPECT_EQ(json["joints"][1]["label"], "E");
  const Json& best = json["solutions"][0];
  EXPECT_EQ(best["branch"], "front, elbow up");
  EXPECT_EQ(best["counts"], Json::parse(R"({"F":71,"E":543,"D":-479,"C":0,"B":260})"));
  EXPECT_EQ(best["positions"]["D"], 64);
  EXPECT_EQ(best["allowed"], true);
  EXPECT_NEAR(best["values"][4].get<double>(), -8.78, 0.01);
  EXPECT_LT(best["exact_error"]["mm"].get<double>(), 1e-6);
  const Json& worse = json["solutions"].back();
  EXPECT_EQ(worse["allowed"], false);
  EXPECT_GT(worse["beyond_limits"][0]["counts"].get<int>(), 0);
}

TEST(KinReport, InverseJsonOfAnUnreachablePose) {
  const Json json = solved(*test::rhino(), pose({300, 0, 200, 0, 0, 170}));
  EXPECT_EQ(json["refusal"]["code"], "approach_out_of_plane");
  EXPECT_NEAR(json["refusal"]["off_deg"].get<double>(), 10, 1e-9);
  EXPECT_EQ(json["solutions"], Json::array());
}

TEST(KinWords, EveryMethodRefusalAndFreedomHasACodeAndAText) {
  for (const InverseMethod method : {InverseMethod::kFiveAxisArm, InverseMethod::kScara,
                                     InverseMethod::kSixAxisArm, InverseMethod::kNumerical}) {
    EXPECT_FALSE(described(method).code.empty());
    EXPECT_FALSE(described(method).text.empty());
  }
  for (int i = 1; i <= static_cast<int>(InverseRefusal::kNeedsOrientation); ++i) {
    InverseResult result;
    result.refusal = static_cast<InverseRefusal>(i);
    EXPECT_FALSE(refusal_of(result).code.empty()) << i;
    EXPECT_FALSE(refusal_of(result).text.empty()) << i;
  }
  for (int i = 0; i <= static_cast<int>(InverseFreedom::kMoreThanNeeded); ++i) {
    EXPECT_FALSE(described(static_cast<InverseFreedom>(i)).code.empty()) << i;
    EXPECT_FALSE(described(static_cast<InverseFreedom>(i)).text.empty()) << i;
  }
}

}  // namespace
}  // namespace xr3
