// Texts shared by the reports of `xr3 kin`: names of joints, units and methods, and sentences for
// refusals and freedoms.
#pragma once

#include <string>

#include "core/inverse/inverse.hpp"

namespace xr3 {

/// The label: `E`.
std::string label_of(const Model& model, int index);
/// Label and name: `E shoulder`.
std::string joint_title(const Model& model, int index);
/// The unit of the variable: `deg` or `mm`.
std::string unit_name(const Model& model, int index);

/// A stable code such as `too_far`, and its text for users.
struct CodeAndText {
  std::string code;
  std::string text;
};
CodeAndText described(InverseMethod method);
CodeAndText described(InverseFreedom freedom);
/// The refusal of a result without solutions: the reason, with the error of the pose; empty for
/// kNo.
CodeAndText refusal_of(const InverseResult& result);

/// `allowed`, or the violations, with counts in parentheses: `past limits: D 3.41 deg (30); in
/// the...`
std::string verdict(const Model& model, const InverseSolution& solution);

}  // namespace xr3
