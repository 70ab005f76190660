#include "tools/kin/text.hpp"

#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {

std::string label_of(const Model& model, int index) {
  return std::string(1, model.motor(index).drive.label);
}

std::string joint_title(const Model& model, int index) {
  return label_of(model, index) + " " + printable_line(model.name(index));
}

std::string unit_name(const Model& model, int index) {
  return model.is_length(index) ? "mm" : "deg";
}

CodeAndText described(InverseMethod method) {
  switch (method) {
    case InverseMethod::kFiveAxisArm:
      return {"five_axis_arm", "closed form of a five-axis arm: all solutions"};
    case InverseMethod::kScara: return {"scara", "closed form of a four-axis SCARA: all solutions"};
    case InverseMethod::kSixAxisArm:
      return {"six_axis_arm", "closed form of a six-axis arm: all solutions"};
    case InverseMethod::kNumerical: break;
  }
  return {"numerical",
          "numerical, because this arm has no closed form here: solutions may be missing"};
}

CodeAndText refusal_of(const InverseResult& result) {
  const std::string off_mm = plain_number(result.off_mm) + " mm";
  const std::string off_deg = plain_number(result.off_deg, 4) + " degrees";
  switch (result.refusal) {
    case InverseRefusal::kNo: break;
    case InverseRefusal::kTooFar:
      return {"too_far",
              "out of reach: the wrist would be " + off_mm + " beyond the stretched arm"};
    case InverseRefusal::kTooNear:
      return {"too_near", "out of reach: the wrist would be " + off_mm +
                              " too near, inside the reach of the folded arm"};
    case InverseRefusal::kTooNearAxis:
      return {"too_near_axis", "out of reach: the tip would be " + off_mm +
                                   " too near to the base axis, which the arm passes at an offset"};
    case InverseRefusal::kApproachOutOfPlane:
      return {"approach_out_of_plane",
              "with five axes the approach must lie in the vertical plane through the tip and the "
              "base axis; it is " +
                  off_deg + " out of it (--tolerance allows more)"};
    case InverseRefusal::kApproachNotVertical:
      return {"approach_not_vertical",
              "with four axes the hand points in one direction only; the approach is " + off_deg +
                  " off it (--tolerance allows more)"};
    case InverseRefusal::kNotFound:
      return {"not_found", "the numerical method found no solution; the nearest pose found is " +
                               off_mm + " and " + off_deg + " off"};
    case InverseRefusal::kNeedsOrientation:
      return {"needs_orientation",
              "the tip alone does not determine the joints of this robot: give an orientation"};
  }
  return {};
}

CodeAndText described(InverseFreedom freedom) {
  switch (freedom) {
    case InverseFreedom::kBaseAndRoll:
      return {"base_and_roll",
              "singular: tip and hand lie on the base axis, where base and roll have the same "
              "effect; the base is set to its soft home"};
    case InverseFreedom::kFolded:
      return {"folded",
              "singular: the arm is folded with the wrist on the shoulder and may swing about it; "
              "the first link is set to its soft home"};
    case InverseFreedom::kArmPlane:
      return {"arm_plane",
              "singular: the hand is in line with wrist and shoulder; the arm's plane may turn "
              "about this line while the last roll turns back; the plane is set vertical"};
    case InverseFreedom::kShoulderAxes:
      return {"shoulder_axes",
              "singular: the arm's plane is horizontal, where base and shoulder pitch have the "
              "same effect; the base is set to its soft home"};
    case InverseFreedom::kSlide:
      return {"slide",
              "the arm stands on a slide, which may be elsewhere: it is kept where --slide puts "
              "it, or at its soft home"};
    case InverseFreedom::kMoreThanNeeded:
      return {"more_than_needed",
              "the joints can move while the tool stays in place: these are some of infinitely "
              "many solutions"};
  }
  return {};
}

std::string verdict(const Model& model, const InverseSolution& solution) {
  std::string text;
  for (const LimitExcess& beyond : solution.beyond) {
    text += (text.empty() ? "past limits: " : ", ") + label_of(model, beyond.joint) + " " +
            plain_number(beyond.amount, 2) + " " + unit_name(model, beyond.joint) + " (" +
            std::to_string(beyond.counts) + ")";
  }
  if (solution.in_protected_region)
    text += text.empty() ? "in the protected region" : "; in the protected region";
  return text.empty() ? "allowed" : text;
}

}  // namespace xr3
