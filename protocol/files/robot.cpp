#include "protocol/files/robot.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/consistency.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/files/robot_parts.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr double kMaxAngleDeg = 1e6;
constexpr std::size_t kMaxTerms = 16;

const Range kAngle{-kMaxAngleDeg, kMaxAngleDeg, false, "degrees"};
const Range kRegionSize{0, kMaxLengthMm};

Members<DhRow> dh_members() {
  return {required("theta_deg", &DhRow::theta_deg, number(kAngle)),
          required("d", &DhRow::d_mm, length(kCoordinate)),
          required("a", &DhRow::a_mm, length(kCoordinate)),
          required("alpha_deg", &DhRow::alpha_deg, number(kAngle))};
}

Members<Joint> joint_members() {
  return joined(spread(&Joint::drive, drive_members({"label"})),
                Members<Joint>{required("name", &Joint::name, text(1, 40)),
                               required("variable", &Joint::variable,
                                        choice<JointVariable>({{"theta", JointVariable::kTheta},
                                                               {"d", JointVariable::kD}}))},
                spread(&Joint::dh, dh_members()),
                spread(&Joint::drive,
                       drive_members({"precision", "limits", "speed", "direction", "switch"})));
}

/// A joint. Its home is the Denavit-Hartenberg parameter that its motor changes.
Codec<Joint> joint() {
  Codec<Joint> codec = object(joint_members());
  codec.read = [read = codec.read](const Place& place, Joint& result) {
    const bool is_good = read(place, result);
    const bool turns = result.is_revolute();
    result.drive.home = turns ? result.dh.theta_deg : result.dh.d_mm;
    if (!turns) convert_lengths(result.drive, place.reading.mm_per_unit());
    return is_good;
  };
  return codec;
}

Members<Tool> tool_members() {
  return joined(
      Members<Tool>{required(
          "kind", &Tool::kind,
          choice<ToolKind>({{"parallel", ToolKind::kParallel}, {"angular", ToolKind::kAngular}}))},
      spread(&Tool::drive, drive_members({"label", "precision", "speed", "direction", "limits",
                                          "home", "switch"})),
      Members<Tool>{
          optional("finger_length", &Tool::finger_length_mm, length({0, kMaxLengthMm, true})),
          defaulted("parts", &Tool::parts, list(object(tool_part_members()), 0, kMaxToolParts))});
}

/// The tool. The variable of parallel jaws is a length, so its drive is converted, too.
Codec<Tool> tool() {
  Codec<Tool> codec = object(tool_members());
  codec.read = [read = codec.read](const Place& place, Tool& result) {
    const bool is_good = read(place, result);
    if (result.kind == ToolKind::kParallel) {
      convert_lengths(result.drive, place.reading.mm_per_unit());
      result.drive.home *= place.reading.mm_per_unit();
    }
    return is_good;
  };
  return codec;
}

Members<Carousel> carousel_members() {
  const auto center = row<Carousel>("a list [x, y] of two lengths", length(kCoordinate),
                                    {&Carousel::x_mm, &Carousel::y_mm});
  return joined(
      spread(&Carousel::drive, drive_members({"label"})),
      Members<Carousel>{required("name", &Carousel::name, text(1, 40))},
      spread(&Carousel::drive,
             drive_members({"precision", "limits", "speed", "direction", "switch"})),
      Members<Carousel>{required("center", center),
                        required("radius", &Carousel::radius_mm, length({0, kMaxLengthMm, true})),
                        required("height", &Carousel::height_mm, length(kCoordinate)),
                        required("color", &Carousel::color, whole_number(0, 15))});
}

/// A joint's number in the file: from 1, negative for "against" or "subtracted".
int signed_number(int joint, int sign) { return sign * (joint + 1); }

Codec<Coupling> coupling() {
  const std::string allowed =
      "[joint, coupled joint], numbers from 1, the second negative if against";
  Codec<Coupling> codec;
  codec.allowed = allowed;
  codec.read = [allowed, first = whole_number(1, kMaxJoints),
                second = whole_number(-kMaxJoints, kMaxJoints)](const Place& place,
                                                                Coupling& result) {
    if (!place.value.is_list() || place.value.size() != 2) return place.refuse(allowed);
    int joint = 1;
    int coupled = 1;
    const bool has_joint = first.read(place.element(0), joint);
    if (!second.read(place.element(1), coupled) || !has_joint) return false;
    if (coupled == 0) return place.element(1).refuse("a joint's number, or minus it");
    result = {joint - 1, std::abs(coupled) - 1, coupled > 0 ? 1 : -1};
    return true;
  };
  codec.write = [](const Coupling& c) {
    return Json::array({c.joint + 1, signed_number(c.coupled, c.sign)});
  };
  return codec;
}

Codec<RollTerm> roll_term() {
  Codec<RollTerm> codec;
  codec.allowed = "a joint's number, or minus it";
  codec.read = [allowed = codec.allowed, any = whole_number(-kMaxJoints, kMaxJoints)](
                   const Place& place, RollTerm& result) {
    int term = 0;
    if (!any.read(place, term)) return false;
    if (term == 0) return place.refuse(allowed);
    result = {std::abs(term) - 1, term > 0 ? 1 : -1};
    return true;
  };
  codec.write = [](const RollTerm& term) { return Json(signed_number(term.joint, term.sign)); };
  return codec;
}

Members<ProtectedRegion> region_members() {
  return {required("radius", &ProtectedRegion::radius_mm, length(kRegionSize)),
          required("height", &ProtectedRegion::height_mm, length(kRegionSize))};
}

const Members<Robot>& robot_members() {
  static const Members<Robot> members = {
      required("name", &Robot::name, text(1, 80)),
      optional("notes", &Robot::notes, text(0, 4000)),
      length_unit_member<Robot>(),
      optional("mount", &Robot::mount, object(dh_members())),
      required("joints", &Robot::joints, list(joint(), 1, kMaxJoints)),
      required("tool", &Robot::tool, tool()),
      optional("carousel", &Robot::carousel, object(carousel_members())),
      defaulted("links", &Robot::links, list(object(outline_members()), 0, kMaxMotors)),
      defaulted("coupling", &Robot::couplings, list(coupling(), 0, kMaxTerms)),
      defaulted("protected_region", &Robot::protected_region, object(region_members())),
      defaulted("net_roll", &Robot::net_roll, list(roll_term(), 0, kMaxJoints)),
      defaulted("net_roll_offset_deg", &Robot::net_roll_offset_deg, number(kAngle))};
  return members;
}

}  // namespace

FileReading<Robot> read_robot(std::string_view text, const std::string& file) {
  return read_file(text, file, DataKind::kRobot, Unit::kOfDocument, [](Reading& reading) {
    return read_root(reading, robot_members(), check_robot);
  });
}

Robot load_robot(std::string_view text, const std::string& file) {
  return value_of(read_robot(text, file));
}

Json robot_to_json(const Robot& robot) { return write_object(robot, robot_members()); }

}  // namespace xr3
