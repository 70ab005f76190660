// Reads and writes robot files in plain form (paper, Section III-A and Table II); declared in
// paper_form.hpp.
#include "protocol/files/robot.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/files/paper_form/writer.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {
namespace {

using namespace paper;  // NOLINT: keeps the tables below readable

constexpr std::size_t kMaxPoints = 4096;
constexpr std::size_t kMaxPairs = 16;
constexpr double kUsualFingerInches = 2;

const Extras kRobotExtras = {{"name", "/name"},
                             {"notes", "/notes"},
                             {"length_unit", "/length_unit"},
                             {"mount_theta_deg", "/mount/theta_deg"},
                             {"mount_d", "/mount/d"},
                             {"mount_a", "/mount/a"},
                             {"mount_alpha_deg", "/mount/alpha_deg"},
                             {"carousel", "/carousel/label"},
                             {"carousel_name", "/carousel/name"},
                             {"carousel_precision", "/carousel/precision"},
                             {"carousel_limits", "/carousel/limits"},
                             {"carousel_speed", "/carousel/speed"},
                             {"carousel_direction", "/carousel/direction"},
                             {"carousel_switch_position", "/carousel/switch/position"},
                             {"carousel_switch_mask", "/carousel/switch/mask"},
                             {"carousel_switch_width", "/carousel/switch/width"},
                             {"carousel_switch_period", "/carousel/switch/period"},
                             {"carousel_center", "/carousel/center"},
                             {"carousel_radius", "/carousel/radius"},
                             {"carousel_height", "/carousel/height"},
                             {"carousel_color", "/carousel/color"},
                             {"net_roll_offset_deg", "/net_roll_offset_deg"}};
const Extras kJointExtras = {
    {"joint", "/name"}, {"switch_width", "/switch/width"}, {"switch_period", "/switch/period"}};
const Extras kToolExtras = {{"home", "/home"},
                            {"direction", "/direction"},
                            {"finger_length", "/finger_length"},
                            {"switch_width", "/switch/width"},
                            {"switch_period", "/switch/period"}};
const Extras kPartExtras = {{"pivot", "/pivot"}};

const DataRow kPrecision{"precision, degrees or length a count", {{"/precision"}}, "/precision"};
const DataRow kLimits{
    "limits, degrees or length: min max", {{"/limits/0"}, {"/limits/1"}}, "/limits"};
const DataRow kSpeed{"speed, counts a second", {{"/speed"}}, "/speed"};
const DataRow kPosition{"microswitch position, counts", {{"/switch/position"}}, "/switch/position"};
const DataRow kMask{"microswitch mask", {{"/switch/mask"}}, "/switch/mask"};
const DataRow kDirection{"direction, 1 or -1", {{"/direction"}}, "/direction"};
const DataRow kLabel{"label", {{"/label", {}, true}}, "/label"};

/// The rows of Table II, from top to bottom.
const std::vector<DataRow> kJointRows = {
    {"joint angle theta, degrees", {{"/theta_deg"}}, "/theta_deg"},
    {"joint distance d, length", {{"/d"}}, "/d"},
    {"link length a, length", {{"/a"}}, "/a"},
    {"link twist angle alpha, degrees", {{"/alpha_deg"}}, "/alpha_deg"},
    {"joint variable, 1 theta or 2 d", {{"/variable", {{1, "theta"}, {2, "d"}}}}, "/variable"},
    kPrecision,
    kLimits,
    kSpeed,
    kPosition,
    kMask,
    kDirection,
    kLabel};

const std::vector<DataRow> kToolRows = {{"tool type, 1 parallel or 2 angular jaws",
                                         {{"/kind", {{1, "parallel"}, {2, "angular"}}}},
                                         "/kind"},
                                        kPrecision,
                                        kSpeed,
                                        kLimits,
                                        kPosition,
                                        kMask,
                                        kLabel};

const DataRow kPartRow{"side 1 or -1, colour, number of points",
                       {{"/side"}, {"/color"}, {"/points"}}};
const DataRow kLinkRow{"colour, number of points", {{"/color"}, {"/points"}}};
const DataRow kPointRow{"command 1 move or 0 draw, x, y, z",
                        {{"/0", {{1, "move"}, {0, "draw"}}}, {"/1"}, {"/2"}, {"/3"}}};
const DataRow kPairRow{"joint and the joint coupled to it, negative if against", {{"/0"}, {"/1"}}};
const DataRow kRegionRow{"protected region: height, radius", {{"/height"}, {"/radius"}}};

constexpr const char* kAxesTitle = "number of axes";
constexpr const char* kPartsTitle = "number of moving parts of the tool";
constexpr const char* kLinksTitle = "number of links drawn, the base as well; or 0";
constexpr const char* kPairsTitle = "number of pairs of coupled joints";
constexpr const char* kRollTitle = "net roll: joints, negative if subtracted; or 0";

std::string element(const std::string& list, std::size_t index) {
  return child_pointer(list, index);
}

// Reading.

void read_rows(PaperReader& reader, const std::vector<DataRow>& rows, const std::string& part) {
  for (const DataRow& row : rows) reader.row(row, part);
}

void read_joints(PaperReader& reader) {
  const std::size_t joints = reader.count(kAxesTitle, "/joints", kMaxJoints, 1);
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string joint = element("/joints", i);
    reader.open(joint, kJointExtras);
    read_rows(reader, kJointRows, joint);
    reader.set_default(joint + "/name", "joint " + std::to_string(i + 1));
    reader.close();
  }
}

void read_points(PaperReader& reader, const std::string& outline) {
  const std::string points = outline + "/points";
  const std::size_t count = reader.count_at(points, points, kMaxPoints);
  for (std::size_t i = 0; i < count; ++i) reader.row(kPointRow, element(points, i));
}

/// Reads a table of outlines: the tool's moving parts or the links.
void read_outlines(PaperReader& reader, const std::string& list, std::size_t count,
                   const DataRow& row, const Extras& extras) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string outline = element(list, i);
    reader.open(outline, extras);
    if (reader.row(row, outline)) read_points(reader, outline);
    reader.close();
  }
}

std::optional<double> number_at(const PaperReader& reader, const std::string& pointer) {
  const Json value = reader.value(pointer);
  if (!value.is_number()) return std::nullopt;
  return value.get<double>();
}

/// The paper's form has no home of the tool. It is chosen such that the jaws are at a limit, open
/// or shut, where their switch closes.
void default_home(PaperReader& reader) {
  const auto min = number_at(reader, "/tool/limits/0");
  const auto max = number_at(reader, "/tool/limits/1");
  const auto precision = number_at(reader, "/tool/precision");
  const auto position = number_at(reader, "/tool/switch/position");
  const auto direction = number_at(reader, "/tool/direction");
  if (!min || !max || !precision || !position || !direction) return;
  const double travel = *position * *direction * *precision;
  const double home = travel >= 0 ? *max - travel : *min - travel;
  if (home >= *min && home <= *max) reader.set_default("/tool/home", home);
}

/// The fingers of angular jaws end at the tip. Their hinge is at the point of a moving part that is
/// furthest from it.
double finger_length(const PaperReader& reader) {
  double furthest = 0;
  const Json parts = reader.value("/tool/parts");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string points = element("/tool/parts", i) + "/points";
    for (std::size_t j = 0; j < reader.value(points).size(); ++j) {
      furthest = std::min(furthest, number_at(reader, element(points, j) + "/3").value_or(0));
    }
  }
  const bool is_inch = reader.value("/length_unit") == "inch";
  return furthest < 0 ? -furthest : kUsualFingerInches * (is_inch ? 1 : data::kMmPerInch);
}

void default_hinges(PaperReader& reader) {
  if (reader.value("/tool/kind") != "angular") return;
  reader.set_default("/tool/finger_length", finger_length(reader));
  const double length = number_at(reader, "/tool/finger_length").value_or(0);
  for (std::size_t i = 0; i < reader.value("/tool/parts").size(); ++i) {
    reader.set_default(element("/tool/parts", i) + "/pivot", Json::array({0, 0, -length}));
  }
}

void read_tool(PaperReader& reader) {
  reader.open("/tool", kToolExtras);
  read_rows(reader, kToolRows, "/tool");
  const std::size_t parts = reader.count(kPartsTitle, "/tool/parts", kMaxToolParts);
  reader.close();
  read_outlines(reader, "/tool/parts", parts, kPartRow, kPartExtras);
}

void read_general(PaperReader& reader) {
  const std::size_t pairs = reader.count(kPairsTitle, "/coupling", kMaxPairs);
  for (std::size_t i = 0; i < pairs; ++i) reader.row(kPairRow, element("/coupling", i));
  reader.row(kRegionRow, "/protected_region");
  reader.list(kRollTitle, "/net_roll");
  if (reader.value("/net_roll") == Json::array({0})) reader.set("/net_roll", Json::array());
}

void set_defaults(PaperReader& reader) {
  reader.set_default("/name", stem_of(reader.file()));
  reader.set_default("/length_unit", "mm");
  reader.set_default("/net_roll_offset_deg", 0);
  reader.set_default("/tool/direction", 1);
  default_home(reader);
  default_hinges(reader);
}

// Writing.

void write_points(PaperWriter& writer, const Json& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    i == 0 ? writer.row(kPointRow, points[i]) : writer.line(kPointRow, points[i]);
  }
}

void write_outlines(PaperWriter& writer, const std::string& title, const Json& outlines,
                    const DataRow& row, const Extras& extras, int first) {
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    Json counted = outlines[i];
    counted["points"] = counted["points"].size();
    writer.comment("--- " + title + " " + std::to_string(first + static_cast<int>(i)));
    writer.extras(extras, counted);
    writer.row(row, counted);
    write_points(writer, outlines[i]["points"]);
  }
}

void write_rows(PaperWriter& writer, const std::vector<DataRow>& rows, const Json& part) {
  for (const DataRow& row : rows) writer.row(row, part);
}

void write_joints(PaperWriter& writer, const Json& joints) {
  writer.number(kAxesTitle, joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    writer.comment("--- joint " + std::to_string(i + 1));
    writer.extras(kJointExtras, joints[i]);
    write_rows(writer, kJointRows, joints[i]);
  }
}

void write_tool(PaperWriter& writer, const Json& tool) {
  writer.comment("--- tool");
  writer.extras(kToolExtras, tool);
  write_rows(writer, kToolRows, tool);
  writer.number(kPartsTitle, tool["parts"].size());
  write_outlines(writer, "moving part", tool["parts"], kPartRow, kPartExtras, 1);
}

void write_general(PaperWriter& writer, const Json& robot) {
  writer.comment("--- general");
  writer.number(kPairsTitle, robot["coupling"].size());
  for (const Json& pair : robot["coupling"]) writer.row(kPairRow, pair);
  writer.row(kRegionRow, robot["protected_region"]);
  DataRow roll{kRollTitle, {}};
  Json joints = robot["net_roll"];
  if (joints.empty()) joints.push_back(0);
  for (std::size_t i = 0; i < joints.size(); ++i) roll.cells.push_back({"/" + std::to_string(i)});
  writer.row(roll, joints);
}

}  // namespace

FileReading<Robot> read_paper_robot(std::string_view text, const std::string& file) {
  PaperReader reader(text, file);
  reader.open("", kRobotExtras);
  read_joints(reader);
  read_tool(reader);
  const std::size_t links = reader.count(kLinksTitle, "/links", kMaxMotors);
  read_outlines(reader, "/links", links, kLinkRow, {});
  read_general(reader);
  reader.finish();
  set_defaults(reader);
  return reader.merged(read_robot(reader.json(), file));
}

std::string robot_to_paper_form(const Robot& robot) {
  const Json json = robot_to_json(robot);
  PaperWriter writer;
  writer.comment("robot data file; docs/paper-form.md describes the form");
  writer.extras(kRobotExtras, json);
  write_joints(writer, json["joints"]);
  write_tool(writer, json["tool"]);
  writer.number(kLinksTitle, json["links"].size());
  write_outlines(writer, "link", json["links"], kLinkRow, {}, 0);
  write_general(writer, json);
  return writer.take();
}

}  // namespace xr3
