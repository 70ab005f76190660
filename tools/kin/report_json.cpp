// The reports of `xr3 kin` as JSON; declared in report.hpp.
#include <nlohmann/json.hpp>

#include "protocol/monitor/snapshot.hpp"
#include "tools/kin/pose.hpp"
#include "tools/kin/report.hpp"
#include "tools/kin/text.hpp"

namespace xr3 {
namespace {

constexpr int kJsonDecimals = 9;

Json json_number(double value) { return rounded(value, kJsonDecimals); }

template <class Vector>
Json vector_json(const Vector& vector) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(json_number(vector(i)));
  return list;
}

template <class Matrix>
Json matrix_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    rows.push_back(vector_json(matrix.row(row)));
  return rows;
}

Json error_json(const PoseError& error) {
  return {{"mm", json_number(error.mm)}, {"deg", json_number(error.deg)}};
}

Json names_json(const Model& model, int index) {
  return {{"label", label_of(model, index)},
          {"name", model.name(index)},
          {"unit", unit_name(model, index)}};
}

Json motor_json(const Model& model, int index, const KinMotor& motor) {
  Json json = names_json(model, index);
  json["value"] = json_number(motor.variable);
  json["count"] = motor.count;
  json["position"] = motor.position;
  json["value_at_position"] = json_number(motor.rounded);
  json["counts_past_limit"] = motor.past_limit;
  return json;
}

Json tool_json(const KinPose& pose) {
  const Transform tool = pose.tool();
  const Eigen::Matrix3d rotation = tool.block<3, 3>(0, 0);
  return {{"xyz_mm", vector_json(tool.block<3, 1>(0, 3))},
          {"rotation", matrix_json(rotation)},
          {"approach", vector_json(rotation.col(2))},
          {"yaw_pitch_roll_deg", vector_json(yaw_pitch_roll_deg(rotation))},
          {"configuration", vector_json(pose.w)},
          {"net_roll_deg", json_number(pose.net_roll_deg)},
          {"opening_mm", json_number(pose.opening_mm)},
          {"in_protected_region", pose.in_protected_region},
          {"rounded_error", error_json(pose.rounded)}};
}

/// An object that maps labels to counts.
Json counts_json(const Model& model, const Positions& counts) {
  Json json = Json::object();
  for (int k = 0; k < model.joint_count(); ++k)
    json[label_of(model, k)] = counts[static_cast<std::size_t>(k)];
  return json;
}

Json beyond_json(const Model& model, const std::vector<LimitExcess>& beyond) {
  Json list = Json::array();
  for (const LimitExcess& excess : beyond) {
    Json json = names_json(model, excess.joint);
    json["counts"] = excess.counts;
    json["amount"] = json_number(excess.amount);
    list.push_back(std::move(json));
  }
  return list;
}

Json solution_json(const Model& model, const InverseSolution& solution) {
  Json values = Json::array();
  for (const double variable : solution.variables) values.push_back(json_number(variable));
  return {{"branch", solution.branch},
          {"values", std::move(values)},
          {"counts", counts_json(model, solution.counts.motors)},
          {"positions", counts_json(model, solution.counts.positions)},
          {"allowed", solution.is_allowed()},
          {"beyond_limits", beyond_json(model, solution.beyond)},
          {"in_protected_region", solution.in_protected_region},
          {"exact_error", error_json(solution.exact)},
          {"rounded_error", error_json(solution.rounded)}};
}

Json target_json(const ToolTarget& target) {
  Json json = {{"xyz_mm", vector_json(target.p_mm)}};
  if (target.kind == TargetKind::kPose) json["rotation"] = matrix_json(target.rotation);
  if (target.kind == TargetKind::kTip) return json;
  json["approach"] = vector_json(target.approach());
  if (target.kind == TargetKind::kPointing) json["last_joint"] = json_number(target.last);
  return json;
}

Json refusal_json(const InverseResult& result) {
  if (result.refusal == InverseRefusal::kNo) return nullptr;
  const CodeAndText refusal = refusal_of(result);
  return {{"code", refusal.code},
          {"message", refusal.text},
          {"off_mm", json_number(result.off_mm)},
          {"off_deg", json_number(result.off_deg)}};
}

Json freedoms_json(const InverseResult& result) {
  Json list = Json::array();
  for (const InverseFreedom each : result.freedoms) {
    const CodeAndText freedom = described(each);
    list.push_back({{"code", freedom.code}, {"message", freedom.text}});
  }
  return list;
}

}  // namespace

Json direct_json(const Model& model, const DirectQuestion& question) {
  const KinPose pose = kin_pose(model, question);
  Json motors = Json::array();
  for (int i = 0; i <= model.tool_index(); ++i)
    motors.push_back(motor_json(model, i, pose.motors[static_cast<std::size_t>(i)]));
  Json links = Json::array();
  for (std::size_t k = 1; k < pose.bases.size(); ++k) {
    links.push_back({{"k", k},
                     {"label", label_of(model, static_cast<int>(k) - 1)},
                     {"previous", matrix_json(pose.links[k - 1])},
                     {"base", matrix_json(pose.bases[k])}});
  }
  return {{"robot", model.robot().name},
          {"motors", std::move(motors)},
          {"links", std::move(links)},
          {"tool", tool_json(pose)}};
}

Json inverse_json(const Model& model, const ToolTarget& target, const InverseResult& result) {
  Json joints = Json::array();
  for (int k = 0; k < model.joint_count(); ++k) joints.push_back(names_json(model, k));
  Json solutions = Json::array();
  for (const InverseSolution& solution : result.solutions)
    solutions.push_back(solution_json(model, solution));
  return {{"robot", model.robot().name},      {"method", described(result.method).code},
          {"joints", std::move(joints)},      {"target", target_json(target)},
          {"refusal", refusal_json(result)},  {"free", freedoms_json(result)},
          {"solutions", std::move(solutions)}};
}

}  // namespace xr3
