// Equations (1) to (3) of the paper: the published figures of three robots; each link's matrix
// compared with its definition as four elementary moves; and tool_tip() compared with the matrix
// product.
#include "core/kinematics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::model_of;
using test::odd_arm;
using test::positions_at;
using test::robot_named;

constexpr double kGoldenMm = 1e-4;

struct GoldenTip {
  const char* robot;
  std::initializer_list<LabelledCount> counts;
  Eigen::Vector3d tip_mm;
};

const GoldenTip kTips[] = {
    {"rhino-xr3", {}, {238.1, 0, 320.7}},
    {"rhino-xr3",
     {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}},
     {247.9346, 92.3095, 293.7373}},
    {"rhino-xr3",
     {{'F', 90}, {'E', 40}, {'D', 60}, {'C', -30}, {'B', 48}},
     {229.1992, 85.3340, 346.8224}},
    {"rhino-xr3", {{'E', 449}, {'D', -625}}, {261.7195, 0, 20.0178}},
    {"adept-one", {}, {800, 0, 577}},
    {"adept-one", {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}}, {640.0754, 139.7362, 520}},
    {"intelledex-660", {}, {838.2, 0, 373.4}},
    {"intelledex-660",
     {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}},
     {470.0607, 119.8170, 15.2739}},
};

TEST(Kinematics, TipsOfThreeRobots) {
  for (const GoldenTip& golden : kTips) {
    const ModelPtr model = model_of(robot_named(golden.robot));
    const Eigen::Vector3d tip =
        tool_transform(*model, positions_at(*model, golden.counts)).block<3, 1>(0, 3);
    EXPECT_LT((tip - golden.tip_mm).cwiseAbs().maxCoeff(), kGoldenMm)
        << golden.robot << " at " << tip.transpose();
  }
}

struct ConfigurationGolden {
  const char* robot;
  std::initializer_list<LabelledCount> counts;
  Eigen::Vector3d approach;
  Eigen::Vector3d w456;
};

const ConfigurationGolden kConfigurations[] = {
    {"rhino-xr3", {}, {0, 0, -1}, {0, 0, -0.60653}},
    {"rhino-xr3",
     {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}},
     {0.0557, 0.0207, -0.9982},
     {0.03669, 0.01366, -0.65808}},
    {"adept-one", {}, {0, 0, -1}, {0, 0, -1.64872}},
    {"adept-one", {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}}, {0, 0, -1}, {0, 0, -0.73544}},
    {"intelledex-660", {}, {1, 0, 0}, {1, 0, 0}},
    {"intelledex-660",
     {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}},
     {0, 0, -1},
     {0, 0, -0.8917}},
};

TEST(Kinematics, ApproachAndToolConfigurationVector) {
  for (const ConfigurationGolden& golden : kConfigurations) {
    const ModelPtr model = model_of(robot_named(golden.robot));
    const Positions at = positions_at(*model, golden.counts);
    const Transform pose = tool_transform(*model, at);
    const ToolConfiguration w = tool_configuration(*model, at);
    EXPECT_LT((pose.block<3, 1>(0, 2) - golden.approach).cwiseAbs().maxCoeff(), 5e-5)
        << golden.robot << ": approach " << pose.block<3, 1>(0, 2).transpose();
    EXPECT_LT((w.tail<3>() - golden.w456).cwiseAbs().maxCoeff(), 5e-5)
        << golden.robot << ": w " << w.transpose();
    EXPECT_EQ(w.head<3>(), (pose.block<3, 1>(0, 3)));
  }
}

// A drawing program of the 1980s intended the wrist axis at (4, 12) inches from the shoulder axis.
TEST(Kinematics, TheWristOfADrawingProgramIsAtItsDocumentedPlace) {
  const ModelPtr model = test::rhino();
  const auto frames = base_transforms(*model, positions_at(*model, {{'E', -224}, {'D', 219}}));
  const Eigen::Vector3d wrist = (frames[3] - frames[1]).block<3, 1>(0, 3) / 25.4;
  EXPECT_NEAR(wrist.x(), 4.30, 0.005);
  EXPECT_NEAR(wrist.z(), 11.91, 0.005);
}

struct GraspGolden {
  const char* robot;
  Eigen::Vector3d block_mm;
  double yaw_deg;
  std::initializer_list<LabelledCount> counts;
};

const GraspGolden kGrasps[] = {
    {"rhino-xr3", {262, 0, 20}, 90, {{'E', 449}, {'D', -625}}},
    {"rhino-xr3", {330, 96, 15}, 25, {{'F', 71}, {'E', 543}, {'D', -479}, {'B', 260}}},
    {"rhino-xr3", {344, -92, 15}, 140, {{'F', -66}, {'E', 559}, {'D', -455}, {'B', -208}}},
    {"rhino-xr3", {212, 136, 12}, 60, {{'F', 144}, {'E', 460}, {'D', -655}, {'B', 201}}},
    {"rhino-xr3", {214, -130, 18}, 10, {{'F', -138}, {'E', 445}, {'D', -649}, {'B', 156}}},
    {"adept-one", {560, 0, 520}, 90, {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}}},
    {"adept-one", {640, 140, 520}, 30, {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}}},
    {"adept-one", {620, -150, 515}, 115, {{'E', 209}, {'D', 744}, {'C', 124}, {'B', -251}}},
    {"adept-one", {420, 160, 515}, 70, {{'E', 715}, {'D', 1120}, {'C', 124}, {'B', -65}}},
    {"adept-one", {430, -140, 525}, 160, {{'E', 325}, {'D', 1115}, {'C', 104}, {'B', -477}}},
    {"intelledex-660", {400, 0, 20}, 0, {{'E', 293}, {'D', -932}, {'C', -261}}},
    {"intelledex-660",
     {470, 120, 15},
     35,
     {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}}},
    {"intelledex-660",
     {460, -130, 15},
     110,
     {{'G', -158}, {'E', 205}, {'D', -713}, {'C', -392}, {'B', 174}}},
    {"intelledex-660",
     {290, 150, 12},
     65,
     {{'G', 273}, {'E', 325}, {'D', -1094}, {'C', -132}, {'B', -120}}},
    {"intelledex-660",
     {280, -140, 18},
     160,
     {{'G', -266}, {'E', 343}, {'D', -1127}, {'C', -116}, {'B', -21}}},
};

// Within the effect of half a count of each joint at full reach.
TEST(Kinematics, TheJawsReachEveryBlockOfTheWorkcells) {
  for (const GraspGolden& golden : kGrasps) {
    const ModelPtr model = model_of(robot_named(golden.robot));
    const Positions at = positions_at(*model, golden.counts);
    const Transform pose = tool_transform(*model, at);
    const Eigen::Vector3d miss = pose.block<3, 1>(0, 3) - golden.block_mm;
    EXPECT_LT(miss.norm(), 1.2) << golden.robot << " misses by " << miss.transpose();
    EXPECT_LT(pose(2, 2), -0.99999) << golden.robot << ": tool not down";
    EXPECT_LT(std::abs(std::remainder(net_roll_deg(*model, at) - golden.yaw_deg, 90.0)), 0.3)
        << golden.robot << ": net roll " << net_roll_deg(*model, at);
  }
}

// The tool points straight down up to half a count of tilt.
TEST(Kinematics, WithTheToolDownNetRollIsTheYawOfItsXAxis) {
  for (const GraspGolden& golden : kGrasps) {
    const ModelPtr model = model_of(robot_named(golden.robot));
    const Positions at = positions_at(*model, golden.counts);
    const Transform pose = tool_transform(*model, at);
    const double yaw = std::atan2(pose(1, 0), pose(0, 0)) * 180.0 / kPi;
    EXPECT_NEAR(std::remainder(net_roll_deg(*model, at) - yaw, 360.0), 0.0, 1e-4) << golden.robot;
  }
  const ModelPtr rhino = test::rhino();
  EXPECT_DOUBLE_EQ(net_roll_deg(*rhino, positions_at(*rhino, {{'E', 449}, {'D', -625}})), 90.0);
}

TEST(Kinematics, OpeningsOfParallelAndAngularJaws) {
  const ModelPtr parallel = test::rhino();
  EXPECT_DOUBLE_EQ(opening_mm(*parallel, 0), 50.8);
  EXPECT_DOUBLE_EQ(opening_mm(*parallel, 64), 0.0);
  EXPECT_DOUBLE_EQ(opening_mm(*parallel, -16), 63.5);
  const ModelPtr angular = model_of(robot_named("intelledex-660"));
  EXPECT_DOUBLE_EQ(opening_mm(*angular, 80), 0.0);
  EXPECT_NEAR(opening_mm(*angular, -40), 60.0, 1e-12);
  EXPECT_NEAR(opening_mm(*angular, 0), 2 * 60 * std::sin(20 * kPi / 180), 1e-12);
}

// Equation (2) by definition: turn and shift along z, then shift and turn along x.
Transform elementary_moves(const DhRow& row) {
  const auto turn = [](double deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(deg * kPi / 180.0, axis);
  };
  const Eigen::Isometry3d moves =
      Eigen::Translation3d(0, 0, row.d_mm) * turn(row.theta_deg, Eigen::Vector3d::UnitZ()) *
      Eigen::Translation3d(row.a_mm, 0, 0) * turn(row.alpha_deg, Eigen::Vector3d::UnitX());
  return moves.matrix();
}

TEST(Kinematics, EachLinkFollowsEquation2) {
  const ModelPtr model = model_of(odd_arm(7));
  for (int joint = 0; joint < model->joint_count(); ++joint) {
    for (const Counts position : {-1999, -250, -1, 0, 1, 77, 2000}) {
      const Joint& link = model->robot().joints[static_cast<std::size_t>(joint)];
      DhRow row = link.dh;
      const bool slides = link.variable == JointVariable::kD;
      (slides ? row.d_mm : row.theta_deg) += link.drive.precision * link.drive.direction * position;
      const Transform got = link_transform(*model, joint, position);
      EXPECT_LT((got - elementary_moves(row)).cwiseAbs().maxCoeff(), 1e-12 * (1 + got.norm()))
          << "joint " << joint << " at " << position;
    }
  }
}

Positions arbitrary_positions(const Model& model) {
  Positions at{};
  for (int i = 0; i < model.motor_count(); ++i) {
    at[static_cast<std::size_t>(i)] = *rc::gen::inRange(-2000, 2001);
  }
  return at;
}

RC_GTEST_PROP(Kinematics, TheTipIsTheOriginOfTheToolFrame, ()) {
  const ModelPtr model = model_of(odd_arm(*rc::gen::inRange(1, 8)));
  const Positions at = arbitrary_positions(*model);
  const Transform pose = tool_transform(*model, at);
  const PointUm tip = tool_tip(*model, at);
  // The two sums differ in their last bits, so a rounding may fall either way.
  RC_ASSERT(std::abs(tip.x - micrometres(pose(0, 3))) <= 1);
  RC_ASSERT(std::abs(tip.y - micrometres(pose(1, 3))) <= 1);
  RC_ASSERT(std::abs(tip.z - micrometres(pose(2, 3))) <= 1);
}

RC_GTEST_PROP(Kinematics, FramesAreRigidProductsOfTheLinks, ()) {
  const ModelPtr model = model_of(odd_arm(*rc::gen::inRange(1, 8)));
  const Positions at = arbitrary_positions(*model);
  const std::vector<Transform> frames = base_transforms(*model, at);
  RC_ASSERT(frames.size() == static_cast<std::size_t>(model->joint_count() + 1));
  RC_ASSERT(frames.front() == Transform(Transform::Identity()));
  RC_ASSERT(frames.back() == tool_transform(*model, at));
  for (const Transform& frame : frames) {
    const Eigen::Matrix3d turn = frame.block<3, 3>(0, 0);
    const Eigen::Matrix3d rest = turn.transpose() * turn - Eigen::Matrix3d::Identity();
    RC_ASSERT(rest.cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST(Kinematics, EachJointTurnsAboutThePreviousAxis) {
  const ModelPtr model = test::rhino();
  const Positions home{};
  Positions turned{};
  turned[1] = 100;  // the shoulder: its axis passes through frame 1's origin
  const auto before = base_transforms(*model, home);
  const auto after = base_transforms(*model, turned);
  EXPECT_EQ(before[1], after[1]);
  const Eigen::Vector3d p_before = before[2].block<3, 1>(0, 3) - before[1].block<3, 1>(0, 3);
  const Eigen::Vector3d p_after = after[2].block<3, 1>(0, 3) - after[1].block<3, 1>(0, 3);
  EXPECT_NEAR(p_before.norm(), 228.6, 1e-9);
  EXPECT_NEAR(std::acos(p_before.dot(p_after) / p_before.squaredNorm()) * 180 / kPi, 11.35, 1e-9);
  EXPECT_LT(p_after.z(), p_before.z()) << "E+ lowers the shoulder";
}

}  // namespace
}  // namespace xr3
