// Words that the reports of `xr3 kin` share: names of joints, units, methods, and the sentences for
// what cannot be and for what is left free.
#pragma once

#include <string>

#include "core/inverse.hpp"

namespace xr3 {

/// `E`
std::string label_of(const Model& model, int index);
/// `shoulder`, or `tool`
std::string joint_name(const Model& model, int index);
/// `E shoulder`
std::string joint_title(const Model& model, int index);
/// `deg` or `mm`
std::string unit_name(const Model& model, int index);

/// `five_axis_arm`, `scara`, `six_axis_arm` or `numerical`
std::string method_code(InverseMethod method);
/// `closed form of a five-axis arm`...
std::string method_words(InverseMethod method);

/// `too_far`...; empty for kNo.
std::string refusal_code(InverseRefusal refusal);
/// One sentence with how far the pose is off, for a result without solutions.
std::string refusal_sentence(const InverseResult& result);

std::string freedom_code(InverseFreedom freedom);
std::string freedom_sentence(InverseFreedom freedom);

/// `allowed`, or what forbids it, counts in brackets: `past limits: D 3.41 deg (30); in the...`
std::string verdict(const Model& model, const InverseSolution& solution);

}  // namespace xr3
