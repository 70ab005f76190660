#include "core/inverse/chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/coupling.hpp"

namespace xr3 {
namespace {

constexpr double kMaxCounts = 2e8;  // sums of coupled counts still fit into Counts

// Like motor_counts() in coupling.cpp, without rounding.
std::array<double, kMaxMotors> exact_motors(const Model& model, const JointVariables& variables) {
  std::array<double, kMaxMotors> counts{};
  const int joints = static_cast<int>(variables.size());
  for (int pass = 0; pass < joints; ++pass) {
    for (int i = 0; i < joints; ++i) {
      const auto own = static_cast<std::size_t>(i);
      double count = exact_position(model.motor(i).drive, variables[own]);
      for (int j = 0; j < joints; ++j) {
        if (j != i) count -= model.gain(i, j) * counts[static_cast<std::size_t>(j)];
      }
      counts[own] = count;
    }
  }
  return counts;
}

Transform row_transform_at(const DhRow& row) {
  return row_transform(sin_cos_deg(row.theta_deg), sin_cos_deg(row.alpha_deg), row.d_mm, row.a_mm);
}

}  // namespace

double exact_position(const Drive& drive, double variable) {
  return (variable - drive.home) / (drive.precision * drive.direction);
}

Counts nearest_count(double counts) {
  return static_cast<Counts>(std::llround(std::clamp(counts, -kMaxCounts, kMaxCounts)));
}

Transform link_transform_at(const Joint& joint, double variable) {
  DhRow row = joint.dh;
  (joint.is_revolute() ? row.theta_deg : row.d_mm) = variable;
  return row_transform_at(row);
}

std::vector<Transform> base_transforms_at(const Robot& robot, const JointVariables& variables) {
  std::vector<Transform> chain{robot.mount ? row_transform_at(*robot.mount)
                                           : Transform::Identity()};
  for (std::size_t k = 0; k < variables.size(); ++k) {
    chain.push_back(chain.back() * link_transform_at(robot.joints[k], variables[k]));
  }
  return chain;
}

Transform tool_transform_at(const Robot& robot, const JointVariables& variables) {
  return base_transforms_at(robot, variables).back();
}

ToolConfiguration tool_configuration_at(const Robot& robot, const JointVariables& variables) {
  return configuration_of(tool_transform_at(robot, variables), robot, variables.back());
}

double net_roll_deg_at(const Robot& robot, const JointVariables& variables) {
  double sum = robot.net_roll_offset_deg;
  for (const RollTerm& term : robot.net_roll) {
    sum += term.sign * variables[static_cast<std::size_t>(term.joint)];
  }
  return sum;
}

JointVariables home_variables(const Robot& robot) {
  JointVariables home;
  for (const Joint& joint : robot.joints) home.push_back(joint.drive.home);
  return home;
}

JointVariables variables_at(const Model& model, const Positions& positions) {
  JointVariables variables;
  for (int k = 0; k < model.joint_count(); ++k) {
    variables.push_back(model.variable(k, positions[static_cast<std::size_t>(k)]));
  }
  return variables;
}

NearestCounts nearest_counts(const Model& model, const JointVariables& variables) {
  const std::array<double, kMaxMotors> exact = exact_motors(model, variables);
  NearestCounts counts;
  for (int i = 0; i < model.joint_count(); ++i) {
    const auto own = static_cast<std::size_t>(i);
    counts.motors[own] = nearest_count(exact[own]);
    turn(model, counts.positions, i, counts.motors[own]);
  }
  return counts;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(const Robot& robot,
                                                  const std::vector<Transform>& base_transforms) {
  const std::size_t joints = base_transforms.size() - 1;
  Eigen::Matrix<double, 6, Eigen::Dynamic> columns(6, joints);
  const Eigen::Vector3d tip = base_transforms.back().block<3, 1>(0, 3);
  for (std::size_t k = 0; k < joints; ++k) {
    const Eigen::Vector3d axis = base_transforms[k].block<3, 1>(0, 2);
    const Eigen::Vector3d arm = tip - base_transforms[k].block<3, 1>(0, 3);
    const bool revolute = robot.joints[k].is_revolute();
    const auto column = static_cast<Eigen::Index>(k);
    columns.col(column).head<3>() = revolute ? axis.cross(arm).eval() : axis;
    columns.col(column).tail<3>() = revolute ? axis : Eigen::Vector3d::Zero().eval();
  }
  return columns;
}

}  // namespace xr3
