// Texts shared by the reports of `xr3 kin`: names of joints, units and methods, and sentences for
// refusals and freedoms.
#pragma once

#include <string>

#include "core/inverse/inverse.hpp"

namespace xr3 {

/// `E`
std::string label_of(const Model& model, int index);
/// `E shoulder`
std::string joint_title(const Model& model, int index);
/// `deg` or `mm`
std::string unit_name(const Model& model, int index);

/// `five_axis_arm`, `scara`, `six_axis_arm` or `numerical`
std::string method_code(InverseMethod method);
/// `closed form of a five-axis arm`...
std::string method_text(InverseMethod method);

/// Such as `too_far`; empty for kNo.
std::string refusal_code(InverseRefusal refusal);
/// For a result without solutions: a sentence with the reason and the error of the pose.
std::string refusal_sentence(const InverseResult& result);

std::string freedom_code(InverseFreedom freedom);
std::string freedom_sentence(InverseFreedom freedom);

/// `allowed`, or the violations, with counts in parentheses: `past limits: D 3.41 deg (30); in
/// the...`
std::string verdict(const Model& model, const InverseSolution& solution);

}  // namespace xr3
