#include "protocol/files/robot.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/drive.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/files/outline.hpp"
#include "protocol/files/robot_consistency.hpp"
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

template <class T>
void append(Members<T>& members, Members<T> more) {
  members.insert(members.end(), more.begin(), more.end());
}

Members<Joint> joint_members() {
  Members<Joint> members = spread(&Joint::drive, Members<Drive>{label_member()});
  members.push_back(required("name", &Joint::name, text(1, 40)));
  members.push_back(required(
      "variable", &Joint::variable,
      choice<JointVariable>({{"theta", JointVariable::kTheta}, {"d", JointVariable::kD}})));
  append(members, spread(&Joint::dh, dh_members()));
  append(members,
         spread(&Joint::drive, Members<Drive>{precision_member(), limits_member(), speed_member(),
                                              direction_member(), switch_member()}));
  return members;
}

/// A joint. Its home is the Denavit-Hartenberg parameter that its motor changes.
Codec<Joint> joint() {
  Codec<Joint> codec = object(joint_members());
  codec.read = [members = joint_members()](const Place& place, Joint& result) {
    const bool is_good = read_object(place, members, result);
    const bool turns = result.is_revolute();
    result.drive.home = turns ? result.dh.theta_deg : result.dh.d_mm;
    if (!turns) convert_lengths(result.drive, place.reading.mm_per_unit());
    return is_good;
  };
  return codec;
}

Members<Tool> tool_members() {
  Members<Tool> members = {required(
      "kind", &Tool::kind,
      choice<ToolKind>({{"parallel", ToolKind::kParallel}, {"angular", ToolKind::kAngular}}))};
  append(members,
         spread(&Tool::drive, Members<Drive>{label_member(), precision_member(), speed_member(),
                                             direction_member(), limits_member(), home_member(),
                                             switch_member()}));
  members.push_back(
      optional("finger_length", &Tool::finger_length_mm, length({0, kMaxLengthMm, true})));
  members.push_back(
      defaulted("parts", &Tool::parts, list(object(tool_part_members()), 0, kMaxToolParts)));
  return members;
}

/// The tool. The variable of parallel jaws is a length, so its drive is converted, too.
Codec<Tool> tool() {
  Codec<Tool> codec = object(tool_members());
  codec.read = [members = tool_members()](const Place& place, Tool& result) {
    const bool is_good = read_object(place, members, result);
    if (result.kind == ToolKind::kParallel) {
      convert_lengths(result.drive, place.reading.mm_per_unit());
      result.drive.home *= place.reading.mm_per_unit();
    }
    return is_good;
  };
  return codec;
}

/// `[x, y]`
Member<Carousel> center_member() {
  const std::string allowed = "a list [x, y] of two lengths";
  Member<Carousel> member;
  member.name = "center";
  member.allowed = allowed;
  member.read = [allowed, coordinate = length(kCoordinate)](const Place& place,
                                                            Carousel& carousel) {
    if (!place.value.is_list() || place.value.size() != 2) return place.refuse(allowed);
    const bool has_x = coordinate.read(place.element(0), carousel.x_mm);
    return coordinate.read(place.element(1), carousel.y_mm) && has_x;
  };
  member.write = [](const Carousel& carousel) {
    return Json::array({number_json(carousel.x_mm), number_json(carousel.y_mm)});
  };
  return member;
}

Members<Carousel> carousel_members() {
  Members<Carousel> members = spread(&Carousel::drive, Members<Drive>{label_member()});
  members.push_back(required("name", &Carousel::name, text(1, 40)));
  append(members, spread(&Carousel::drive,
                         Members<Drive>{precision_member(), limits_member(), speed_member(),
                                        direction_member(), switch_member()}));
  members.push_back(center_member());
  members.push_back(required("radius", &Carousel::radius_mm, length({0, kMaxLengthMm, true})));
  members.push_back(required("height", &Carousel::height_mm, length(kCoordinate)));
  members.push_back(required("color", &Carousel::color, whole_number(0, 15)));
  return members;
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

RobotReading read_robot(std::string_view text, const std::string& file) try {
  const JsonSource source(text, file);
  refuse_other_kinds(source.root(), DataKind::kRobot, file);
  Reading reading(source);
  Robot robot;
  read_object(Place{reading, source.root()}, robot_members(), robot);
  check_robot(robot, reading);
  RobotReading result;
  if (!reading.has_errors()) result.robot = std::move(robot);
  result.findings = reading.take_findings();
  return result;
} catch (const DataError& error) {
  return {std::nullopt, error.findings()};
}

Robot load_robot(std::string_view text, const std::string& file) {
  RobotReading reading = read_robot(text, file);
  if (!reading.robot) throw DataError(std::move(reading.findings));
  return *std::move(reading.robot);
}

Json robot_to_json(const Robot& robot) { return write_object(robot, robot_members()); }

}  // namespace xr3
