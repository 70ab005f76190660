#include "tools/kin/question.hpp"

#include <cmath>
#include <string>

#include "core/coupling.hpp"
#include "tools/kin/text.hpp"

namespace xr3 {
namespace {

constexpr double kMax = 1e7;  // degrees, mm or counts: far above any robot, far below overflow
constexpr double kMinVector = 1e-9;
constexpr std::size_t kMaxJointsForTip = 3;

using Numbers = std::vector<double>;

[[noreturn]] void refuse(const std::string& message) { throw KinQuestionError(message); }

void check_numbers(const std::string& option, const Numbers& numbers) {
  for (const double number : numbers) {
    if (!(std::abs(number) <= kMax)) refuse(option + ": each number is -10000000...10000000");
  }
}

void check_number(const std::string& option, const std::optional<double>& number) {
  if (number) check_numbers(option, {*number});
}

std::string labels_of(const Model& model) {
  std::string labels;
  for (int k = 0; k < model.joint_count(); ++k)
    labels += std::string(k > 0 ? "," : "") + label_of(model, k);
  return labels;
}

/// Requires one number per joint, and optionally one for the tool.
void check_length(const Model& model, const std::string& option, const Numbers& numbers) {
  const auto joints = static_cast<std::size_t>(model.joint_count());
  if (numbers.size() == joints || numbers.size() == joints + 1) return;
  refuse(option + " takes " + std::to_string(joints) + " numbers for the " + model.robot().name +
         ", from the base (" + labels_of(model) +
         "), and optionally the tool's (A) as the last; it got " + std::to_string(numbers.size()));
}

DirectQuestion from_variables(const Model& model, const Numbers& numbers) {
  check_length(model, "--joints", numbers);
  const auto joints = static_cast<std::size_t>(model.joint_count());
  DirectQuestion question{numbers, model.robot().tool.drive.home};
  if (numbers.size() > joints) question.tool = numbers.back();
  question.variables.resize(joints);
  return question;
}

DirectQuestion from_counts(const Model& model, const Numbers& numbers) {
  check_length(model, "--counts", numbers);
  Positions positions{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != std::round(numbers[i])) refuse("--counts: motor counts are whole numbers");
    turn(model, positions, static_cast<int>(i), static_cast<Counts>(numbers[i]));
  }
  const auto tool = static_cast<std::size_t>(model.tool_index());
  return {variables_at(model, positions), model.variable(model.tool_index(), positions[tool])};
}

Eigen::Vector3d vector_of(const Numbers& numbers, std::size_t first = 0) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

ToolTarget configuration_of(const Model& model, const Numbers& w) {
  if (w.size() != 6) refuse("--configuration takes six numbers, w1...w6");
  if (vector_of(w, 3).norm() < kMinVector)
    refuse("--configuration: w4...w6 are the approach vector times exp(q/pi) and cannot all be 0");
  return configuration_target(model.robot(), ToolConfiguration(w.data()));
}

ToolTarget pointing_of(const KinOptionValues& values) {
  if (values.approach.size() != 3 || vector_of(values.approach).norm() < kMinVector)
    refuse("--approach takes three numbers, not all 0: the direction of the hand");
  if (!values.roll) refuse("--approach needs --roll Q, the variable of the last joint");
  return pointing_target(vector_of(values.pose), vector_of(values.approach), *values.roll);
}

ToolTarget pose_of(const Model& model, const KinOptionValues& values) {
  const bool is_turned = values.down || !values.approach.empty() || values.roll;
  if (values.pose.size() == 6) {
    if (is_turned)
      refuse(
          "--pose x,y,z,yaw,pitch,roll already gives the orientation: omit --down, --approach and "
          "--roll");
    return yaw_pitch_roll_target(vector_of(values.pose), vector_of(values.pose, 3));
  }
  if (values.pose.size() != 3) refuse("--pose takes x,y,z or x,y,z,yaw,pitch,roll");
  if (values.down && (values.roll || !values.approach.empty()))
    refuse("--down already gives the orientation: omit --approach and --roll");
  if (values.down) return down_target(vector_of(values.pose), *values.down);
  if (is_turned) return pointing_of(values);
  if (model.robot().joints.size() > kMaxJointsForTip)
    refuse(
        "--pose x,y,z does not give an orientation: add --down NET_ROLL (straight down), or "
        "--approach ax,ay,az --roll Q, or give x,y,z,yaw,pitch,roll");
  return tip_target(vector_of(values.pose));
}

InverseOptions options_of(const Model& model, const KinOptionValues& values) {
  InverseOptions options = values.tolerance;
  options.slide_mm = values.slide;
  if (values.slide && !keeps_slide(model.robot())) {
    refuse("--slide goes with a robot whose arm stands on a slide; that of the " +
           model.robot().name + " does not");
  }
  return options;
}

void check_all_numbers(const KinOptionValues& values) {
  check_numbers("--joints", values.joints);
  check_numbers("--counts", values.counts);
  check_numbers("--pose", values.pose);
  check_numbers("--configuration", values.configuration);
  check_numbers("--approach", values.approach);
  check_number("--down", values.down);
  check_number("--roll", values.roll);
  check_number("--tool", values.tool);
  check_number("--slide", values.slide);
}

}  // namespace

KinQuestion kin_question(const Model& model, const KinOptionValues& values) {
  check_all_numbers(values);
  const int questions = !values.joints.empty() + !values.counts.empty() + !values.pose.empty() +
                        !values.configuration.empty();
  if (questions != 1) refuse("give one of --joints, --counts, --pose and --configuration");
  const bool is_turned = values.down || !values.approach.empty() || values.roll;
  if (values.pose.empty() && is_turned)
    refuse("--down, --approach and --roll go with --pose x,y,z");
  if (values.joints.empty() && values.counts.empty()) {
    if (values.tool) refuse("--tool goes with --joints or --counts");
    const bool by_pose = !values.pose.empty();
    return InverseQuestion{
        by_pose ? pose_of(model, values) : configuration_of(model, values.configuration),
        options_of(model, values)};
  }
  if (values.slide) refuse("--slide goes with --pose or --configuration");
  DirectQuestion question = values.counts.empty() ? from_variables(model, values.joints)
                                                  : from_counts(model, values.counts);
  if (values.tool) question.tool = *values.tool;
  return question;
}

}  // namespace xr3
