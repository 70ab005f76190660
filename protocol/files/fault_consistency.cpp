// The rules of fault files; declared in consistency.hpp.
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "protocol/explain/fault_text.hpp"
#include "protocol/files/consistency.hpp"

namespace xr3 {
namespace {

using data::Reading;

constexpr std::string_view kTargetNames[] = {"a line", "the controller", "a joint", "the jaws",
                                             "the camera"};

/// A member that only some kinds have.
struct MemberOfKinds {
  std::string_view name;
  bool (*has)(FaultKind kind);  ///< the kind allows it
  bool is_required;
  std::string_view allowed;  ///< allowed values, for the error if it is missing
};

bool is_of(FaultKind kind, FaultTarget target) { return traits_of(kind).target == target; }

bool has_line(FaultKind kind) { return is_of(kind, FaultTarget::kLine); }
bool has_joint(FaultKind kind) { return is_of(kind, FaultTarget::kJoint); }
bool has_direction(FaultKind kind) {
  return kind == FaultKind::kByteDropped || kind == FaultKind::kByteFlipped ||
         kind == FaultKind::kByteDoubled || kind == FaultKind::kStrayByte ||
         kind == FaultKind::kParityError;
}
template <FaultKind Only>
bool is_kind(FaultKind kind) {
  return kind == Only;
}

constexpr std::array kMembersOfKinds = {
    MemberOfKinds{"line", has_line, false, ""},
    MemberOfKinds{"direction", has_direction, false, ""},
    MemberOfKinds{"joint", has_joint, true, "the label of a joint"},
    MemberOfKinds{"bit", is_kind<FaultKind::kByteFlipped>, false, ""},
    MemberOfKinds{"byte", is_kind<FaultKind::kStrayByte>, true, "a whole number from 0 to 255"},
    MemberOfKinds{"percent", is_kind<FaultKind::kMotorSlow>, true, "a whole number from 1 to 99"},
    MemberOfKinds{"delay_ms", is_kind<FaultKind::kReplyDelayed>, true,
                  "a whole number from 1 to 60000"},
    MemberOfKinds{"period_ms", is_kind<FaultKind::kReplyBatched>, false, ""},
    MemberOfKinds{"bounce_ms", is_kind<FaultKind::kSwitchBouncing>, false, ""},
    MemberOfKinds{"row", is_kind<FaultKind::kCameraDeadRow>, true, "a whole number from 0 to 2047"},
    MemberOfKinds{"columns", is_kind<FaultKind::kCameraOffset>, false, ""},
    MemberOfKinds{"rows", is_kind<FaultKind::kCameraOffset>, false, ""},
};

/// Checks one fault of a document.
class Checker {
 public:
  Checker(const Fault& fault, std::string pointer, std::string_view labels, Reading& reading)
      : fault_(fault),
        pointer_(std::move(pointer)),
        kind_(code_of(fault.kind)),
        traits_(traits_of(fault.kind)),
        labels_(labels),
        reading_(reading) {}

  void check() {
    if (!reading_.is_sound(pointer_ + "/kind")) return;
    check_members();
    check_joint();
    check_triggers();
    check_duration();
  }

 private:
  bool has(std::string_view member) const {
    return static_cast<bool>(reading_.root().at(pointer_ + "/" + std::string(member)));
  }

  void refuse(std::string_view member, std::string found, std::string allowed) {
    reading_.refuse(pointer_ + "/" + std::string(member), std::move(found), std::move(allowed));
  }

  std::string shown(std::string_view member) const {
    return data::shown(reading_.root().at(pointer_ + "/" + std::string(member)));
  }

  void check_members() {
    for (const MemberOfKinds& each : kMembersOfKinds) {
      const bool allows = each.has(fault_.kind);
      if (has(each.name) && !allows)
        refuse(each.name, shown(each.name),
               "no \"" + std::string(each.name) + "\": " + kind_ + " acts on " +
                   std::string(kTargetNames[static_cast<std::size_t>(traits_.target)]));
      if (allows && each.is_required && !has(each.name))
        refuse(each.name, "", std::string(each.allowed));
    }
    if (fault_.kind == FaultKind::kCameraOffset && !has("columns") && !has("rows"))
      refuse("columns", "", "a number of columns, or else of rows");
  }

  void check_joint() {
    if (labels_.empty() || !has("joint") || !reading_.is_sound(pointer_ + "/joint")) return;
    if (labels_.find(fault_.joint) != std::string_view::npos) return;
    refuse("joint", shown("joint"), "a joint of the robot: one of " + std::string(labels_));
  }

  void refuse_trigger(std::string_view member, bool allows) {
    if (has(member) && !allows)
      refuse(member, shown(member), "another trigger for " + kind_ + ": " + triggers());
  }

  bool has_from_tick() const { return traits_.manner != FaultManner::kOnce; }
  bool needs_chance() const { return fault_.kind == FaultKind::kCameraNoise; }

  /// The triggers that the kind allows.
  std::string triggers() const {
    if (needs_chance()) return "probability";
    std::string names = "at_tick";
    if (has_from_tick()) names += ", from_tick";
    if (traits_.has_after_bytes) names += ", after_bytes";
    if (traits_.has_probability) names += ", probability";
    return names;
  }

  void check_triggers() {
    refuse_trigger("at_tick", !needs_chance());
    refuse_trigger("from_tick", has_from_tick());
    refuse_trigger("after_bytes", traits_.has_after_bytes);
    refuse_trigger("probability", traits_.has_probability);
    const int others = int{has("at_tick")} + int{has("after_bytes")} + int{has("probability")};
    const bool is_one = others == 1 || (others == 0 && has("from_tick") && !needs_chance());
    const bool clashes = has("from_tick") && (has("at_tick") || has("after_bytes"));
    if (is_one && !clashes) return;
    reading_.refuse(pointer_,
                    others + int{has("from_tick")} == 0 ? "no trigger" : "triggers that clash",
                    "one of " + triggers() + "; from_tick may also delay a probability");
  }

  void check_duration() {
    const bool lasts = traits_.manner == FaultManner::kLasting;
    if (has("count") && traits_.manner != FaultManner::kEffects)
      refuse("count", shown("count"),
             lasts ? "ticks: " + kind_ + " lasts" : "no count: " + kind_ + " happens once");
    if (has("ticks") && traits_.manner == FaultManner::kOnce)
      refuse("ticks", shown("ticks"), "no ticks: " + kind_ + " happens once");
    if (has("ticks") && has("after_bytes"))
      refuse("ticks", shown("ticks"), "a count, since the trigger counts bytes");
    if (has("ticks") && has("count")) refuse("count", shown("count"), "ticks or a count, not both");
  }

  const Fault& fault_;
  std::string pointer_;
  std::string kind_;
  const FaultTraits& traits_;
  std::string_view labels_;
  Reading& reading_;
};

}  // namespace

void check_fault(const Fault& fault, const std::string& pointer, std::string_view labels,
                 Reading& reading) {
  Checker(fault, pointer, labels, reading).check();
}

void check_faults(const FaultPlan& plan, std::string_view labels, Reading& reading) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < plan.faults.size(); ++i) {
    const std::string pointer = child_pointer("/faults", i);
    check_fault(plan.faults[i], pointer, labels, reading);
    const bool is_new = names.insert(plan.faults[i].name).second;
    if (!is_new && reading.is_sound(pointer + "/name"))
      reading.refuse(pointer + "/name", "\"" + plan.faults[i].name + "\", a duplicate",
                     "a name that no other fault has");
  }
}

}  // namespace xr3
