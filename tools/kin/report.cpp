#include "tools/kin/report.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"
#include "tools/kin/pose.hpp"
#include "tools/kin/text.hpp"

namespace xr3 {
namespace {

using KinRows = std::vector<std::vector<std::string>>;

constexpr int kDecimals = 4;
constexpr int kAngleDecimals = 3;
constexpr double kLevel = 1e-9;  // below this cosine of the pitch, yaw and roll cannot be separated

template <class Vector>
std::string vector_text(const Vector& vector, int decimals = kDecimals) {
  std::string text;
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    text += (i > 0 ? ", " : "(") + plain_number(vector(i), decimals);
  }
  return text + ")";
}

std::string motors_table(const Model& model, const KinPose& pose) {
  KinRows rows = {
      {"motor", "variable", "", "motor count", "joint position", "variable there", "limits"}};
  for (int i = 0; i <= model.tool_index(); ++i) {
    const KinMotor& motor = pose.motors[static_cast<std::size_t>(i)];
    const std::string limits =
        motor.past_limit == 0 ? "within" : "past by " + std::to_string(motor.past_limit);
    rows.push_back({joint_title(model, i), fixed_number(motor.variable, kAngleDecimals),
                    unit_name(model, i), std::to_string(motor.count),
                    std::to_string(motor.position), fixed_number(motor.rounded, kAngleDecimals),
                    limits});
  }
  return "\nMotors: nearest counts, coupling removed\n" + text_table(rows, "lrlrrrl");
}

std::string links_text(const Model& model, const KinPose& pose) {
  std::string text = "\nLink matrices, lengths in mm\n";
  if (model.robot().mount) text += "T(0,k) is in the base frame, the mount included\n";
  for (std::size_t k = 1; k < pose.bases.size(); ++k) {
    const std::string own = "T(" + std::to_string(k - 1) + "," + std::to_string(k) + ")";
    text += "\n" + own + " of " + joint_title(model, static_cast<int>(k) - 1) + ", and T(0," +
            std::to_string(k) + ")\n";
    KinRows rows;
    for (Eigen::Index row = 0; row < 4; ++row) {
      rows.emplace_back();
      for (const Transform* matrix : {&pose.links[k - 1], &pose.bases[k]}) {
        if (matrix == &pose.bases[k]) rows.back().emplace_back("|");
        for (Eigen::Index column = 0; column < 4; ++column)
          rows.back().push_back(fixed_number((*matrix)(row, column), kDecimals));
      }
    }
    text += text_table(rows, "rrrrlrrrr");
  }
  return text;
}

std::string tool_text(const KinPose& pose) {
  const Transform tool = pose.tool();
  const Eigen::Matrix3d rotation = tool.block<3, 3>(0, 0);
  const KinRows rows{
      {"tip", vector_text(tool.block<3, 1>(0, 3)) + " mm"},
      {"normal (x)", vector_text(rotation.col(0))},
      {"sliding (y)", vector_text(rotation.col(1))},
      {"approach (z)", vector_text(rotation.col(2))},
      {"yaw, pitch, roll", vector_text(yaw_pitch_roll_deg(rotation), kAngleDecimals) + " deg"},
      {"configuration w", vector_text(pose.w, 5)},
      {"net roll", plain_number(pose.net_roll_deg, kAngleDecimals) + " deg"},
      {"jaws", plain_number(pose.opening_mm) + " mm open"},
      {"at whole counts", plain_number(pose.rounded.mm, kDecimals) + " mm and " +
                              plain_number(pose.rounded.deg, kDecimals) + " deg off" +
                              (pose.in_protected_region ? ", in the protected region" : "")}};
  return "\nTool\n" + text_table(rows, "ll");
}

std::string target_text(const Model& model, const ToolTarget& target) {
  const std::string tip = "Target: tip " + vector_text(target.p_mm) + " mm";
  if (target.kind == TargetKind::kTip) return tip + "\n";
  const std::string approach = tip + ", approach " + vector_text(target.approach());
  const int last = model.joint_count() - 1;
  if (target.kind == TargetKind::kPointing)
    return approach + ", " + joint_title(model, last) + " " + plain_number(target.last) + " " +
           unit_name(model, last) + "\n";
  return approach + ",\n        yaw, pitch, roll " +
         vector_text(yaw_pitch_roll_deg(target.rotation), kAngleDecimals) + " deg\n";
}

std::string variables_table(const Model& model, const InverseResult& result) {
  KinRows rows = {{"", "branch"}};
  for (int k = 0; k < model.joint_count(); ++k) rows[0].push_back(joint_title(model, k));
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    rows.push_back({std::to_string(i + 1), result.solutions[i].branch});
    for (const double variable : result.solutions[i].variables)
      rows.back().push_back(fixed_number(variable, kAngleDecimals));
  }
  return "\nJoint variables, degrees and mm\n" +
         text_table(rows, "rl" + std::string(result.solutions[0].variables.size(), 'r'));
}

/// The joints' labels, then one row of counts per solution.
KinRows counts_rows(const Model& model, const InverseResult& result,
                    Positions NearestCounts::*counts) {
  KinRows rows = {{""}};
  for (int k = 0; k < model.joint_count(); ++k) rows[0].push_back(label_of(model, k));
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    const Positions& row = result.solutions[i].counts.*counts;
    rows.push_back({std::to_string(i + 1)});
    for (int k = 0; k < model.joint_count(); ++k)
      rows.back().push_back(std::to_string(row[static_cast<std::size_t>(k)]));
  }
  return rows;
}

std::string counts_table(const Model& model, const InverseResult& result) {
  KinRows rows = counts_rows(model, result, &NearestCounts::motors);
  const std::string numbers(rows[0].size() + 2, 'r');
  rows[0].insert(rows[0].end(), {"off mm", "off deg", "limits and region"});
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    const InverseSolution& solution = result.solutions[i];
    rows[i + 1].insert(rows[i + 1].end(), {fixed_number(solution.rounded.mm, kAngleDecimals),
                                           fixed_number(solution.rounded.deg, kAngleDecimals),
                                           verdict(model, solution)});
  }
  return "\nMotor counts, coupling removed, and the tool's error at whole counts\n" +
         text_table(rows, numbers + "l");
}

/// A table of joint positions. Empty without couplings: the positions are then the motors' counts.
std::string positions_table(const Model& model, const InverseResult& result) {
  if (model.robot().couplings.empty()) return "";
  const KinRows rows = counts_rows(model, result, &NearestCounts::positions);
  return "\nPositions of the joints in counts, coupling included\n" +
         text_table(rows, std::string(rows[0].size(), 'r'));
}

std::string solutions_text(const Model& model, const InverseResult& result) {
  const auto allowed = std::ranges::count_if(result.solutions, &InverseSolution::is_allowed);
  const std::size_t count = result.solutions.size();
  std::string text = "\n" + std::to_string(count) + (count == 1 ? " solution, " : " solutions, ") +
                     std::to_string(allowed) + " allowed by limits and protected region\n";
  for (const InverseFreedom freedom : result.freedoms) text += described(freedom).text + "\n";
  return text + counts_table(model, result) + variables_table(model, result) +
         positions_table(model, result);
}

}  // namespace

Eigen::Vector3d yaw_pitch_roll_deg(const Eigen::Matrix3d& rotation) {
  const double level = std::hypot(rotation(0, 0), rotation(1, 0));
  const double pitch = std::atan2(-rotation(2, 0), level);
  const double yaw = level < kLevel ? 0 : std::atan2(rotation(1, 0), rotation(0, 0));
  const double roll = level < kLevel ? std::atan2(-rotation(1, 2), rotation(1, 1))
                                     : std::atan2(rotation(2, 1), rotation(2, 2));
  return Eigen::Vector3d(yaw, pitch, roll) * (180.0 / kPi);
}

std::string direct_text(const Model& model, const DirectQuestion& question) {
  const KinPose pose = kin_pose(model, question);
  return printable_line(model.robot().name) + ": direct kinematics\n" + tool_text(pose) +
         motors_table(model, pose) + links_text(model, pose);
}

std::string inverse_text(const Model& model, const ToolTarget& target,
                         const InverseResult& result) {
  const std::string heading = printable_line(model.robot().name) + ": inverse kinematics, " +
                              described(result.method).text + "\n" + target_text(model, target);
  if (result.solutions.empty()) return heading + "\nNo solution: " + refusal_of(result).text + "\n";
  return heading + solutions_text(model, result);
}

}  // namespace xr3
