// Every broken file of tests/data/broken with its exact findings: line, JSON pointer, and the
// beginnings of the texts `found` and `allowed`.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "protocol/check/check_report.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

struct Row {
  std::string file;
  int line;
  std::string pointer;
  std::string found;
  std::string allowed;
};

const std::string kFolder = "tests/data/broken/";

/// One row per finding, in order of output.
const std::vector<Row>& rows() {
  static const std::vector<Row> table = {
      {"exercise-types", 1, "/goals", "", "text of 1 to 200 bytes in UTF-8"},
      {"exercise-types", 2, "/title", "\"\"", "text of 1 to 100 bytes in UTF-8"},
      {"exercise-types", 3, "/robot", "5", "text of 1 to 200 bytes in UTF-8"},
      {"exercise-types", 4, "/goal", "an unknown member \"goal\"", "perhaps \"goals\" was meant"},
      {"fault-members", 3, "/faults/0/joint", "\"E\"", "no \"joint\": reply_lost acts on a line"},
      {"fault-members", 4, "/faults/1/line", "1", "no \"line\": encoder_slip acts on a joint"},
      {"fault-members", 4, "/faults/1/joint", "", "the label of a joint"},
      {"fault-members", 5, "/faults/2/row", "", "a whole number from 0 to 2047"},
      {"fault-members", 6, "/faults/3/columns", "", "a number of columns, or else of rows"},
      {"fault-members", 7, "/faults/4/percent", "", "a whole number from 1 to 99"},
      {"fault-members", 8, "/faults/5/byte", "", "a whole number from 0 to 255"},
      {"fault-members", 8, "/faults/5/delay_ms", "5", "no \"delay_ms\": stray_byte acts on a line"},
      {"fault-names", 4, "/faults/1/name", "\"a\", a duplicate", "a name that no other fault has"},
      {"fault-ranges", 2, "/seed", "-1", "a whole number from 0 to"},
      {"fault-ranges", 4, "/faults/0/name", "\"a b\"", "1 to 32 letters, digits, _ or -"},
      {"fault-ranges", 4, "/faults/0/line", "0", "a whole number from 1 to 4294967295, or \"any\""},
      {"fault-ranges", 5, "/faults/1/bit", "8", "a whole number from 0 to 7"},
      {"fault-ranges", 6, "/faults/2/joint", "\"I\"", "\"A\", \"B\", \"C\""},
      {"fault-ranges", 6, "/faults/2/percent", "100", "a whole number from 1 to 99"},
      {"fault-ranges", 7, "/faults/3/delay_ms", "0", "a whole number from 1 to 60000"},
      {"fault-ranges", 7, "/faults/3/probability", "1.5", "a number from 0.000000001 to 1"},
      {"fault-ranges", 8, "/faults/4/probability", "0", "a number from 0.000000001 to 1"},
      {"fault-ranges", 9, "/faults/5/kind", "\"gremlin\"", "\"byte_dropped\", "},
      {"fault-ranges", 10, "/faults/6/at_tick", "-1", "a whole number from 0 to"},
      {"fault-ranges", 11, "/faults/7/direction", "\"up\"", "\"in\" or \"out\""},
      {"fault-ranges", 11, "/faults/7/after_bytes", "0.5", "a whole number from 0 to"},
      {"fault-ranges", 11, "/faults/7/count", "0", "a whole number from 1 to"},
      {"fault-triggers", 3, "/faults/0", "no trigger", "one of at_tick, from_tick, after_bytes"},
      {"fault-triggers", 4, "/faults/1", "triggers that clash", "one of at_tick, from_tick"},
      {"fault-triggers", 5, "/faults/2/probability", "0.5", "another trigger for motor_stuck: at_"},
      {"fault-triggers", 6, "/faults/3/from_tick", "5", "another trigger for power_cycle: at_tick"},
      {"fault-triggers", 7, "/faults/4", "triggers that clash",
       "one of probability; from_tick may"},
      {"fault-triggers", 8, "/faults/5/count", "2", "ticks: switch_stuck_open lasts"},
      {"fault-triggers", 9, "/faults/6/ticks", "2", "a count, since the trigger counts bytes"},
      {"fault-triggers", 10, "/faults/7/count", "2", "ticks or a count, not both"},
      {"fault-triggers", 11, "/faults/8/ticks", "2", "no ticks: power_cycle happens once"},
      {"fault-unknown", 2, "/sed", "an unknown member \"sed\"", "perhaps \"seed\" was meant"},
      {"fault-unknown", 4, "/faults/0/attick", "an unknown member \"attick\"",
       "perhaps \"at_tick\" was meant"},
      {"fault-unknown", 5, "/faults/1/name", "", "1 to 32 letters, digits, _ or -"},
      {"goal-events", 3, "/goals/0/events/0", "\"red grasped\"",
       "\"grasped NAME\" or \"released NAME\", NAME of a"},
      {"goal-events", 3, "/goals/0/events/1", "\"grasped\"",
       "\"grasped NAME\" or \"released NAME\", NAME of a"},
      {"goal-events", 4, "/goals/1/events/0", "[\"grasped\",\"red\"]",
       "text of 1 to 60 bytes in UTF-8"},
      {"goal-events", 5, "/goals/2/events", "", "a list of 1 to 1000"},
      {"goal-failed", 2, "/failed_program", "\"fails\"", "\"counts\""},
      {"goal-kinds", 3, "/goals/0/kind", "\"blok\"",
       "\"block\", \"stacked\", \"sorted\", \"holding\", \"joi"},
      {"goal-kinds", 4, "/goals/1/kind", "",
       "\"block\", \"stacked\", \"sorted\", \"holding\", \"joi"},
      {"goal-kinds", 5, "/goals/2/kind", "\"no-stall\"",
       "\"block\", \"stacked\", \"sorted\", \"holding\", \"joi"},
      {"goal-kinds", 6, "/goals/3", "\"no_stall\"", "an object { \"kind\": ... }"},
      {"goal-missing", 3, "/goals/0/name", "", "text of 1 to 40 bytes in UTF-8"},
      {"goal-missing", 4, "/goals/1/on", "", "text of 1 to 40 bytes in UTF-8"},
      {"goal-missing", 5, "/goals/2/by", "\"weight\"", "\"size\", \"height\" or \"color\""},
      {"goal-missing", 5, "/goals/2/along", "", "\"x\", \"-x\", \"y\" or \"-y\""},
      {"goal-missing", 6, "/goals/3/name", "", "text of 1 to 40 bytes in UTF-8, or null for n"},
      {"goal-missing", 7, "/goals/4/xyz_mm", "", "a list [x, y, z] of three numbers of mm; null"},
      {"goal-none", 1, "/goals", "[]", "a list of 1 to 100"},
      {"goal-not-a-list", 2, "/goals", "an object", "a list of 1 to 100"},
      {"goal-not-json", 3, "", "]", "a value: a number, \"text\", true, false, null,"},
      {"goal-places", 3, "/goals/0", "no place", "one of xyz_mm, box_mm and at, or yaw_deg"},
      {"goal-places", 4, "/goals/1", "several places", "one of xyz_mm, box_mm and at"},
      {"goal-places", 5, "/goals/2/at", "\"red\"", "another block"},
      {"goal-places", 6, "/goals/3/offset_mm", "an offset", "no offset_mm without at"},
      {"goal-places", 7, "/goals/4/on", "\"red\"", "another block"},
      {"goal-places", 8, "/goals/5", "neither value nor count", "value in degrees or mm, or count"},
      {"goal-places", 9, "/goals/6", "value and count", "value in degrees or mm, or count"},
      {"goal-places", 10, "/goals/7/xyz_mm", "no coordinate", "at least one number"},
      {"goal-ranges", 3, "/goals/0/mm", "-5", "a length from 0 to 100000 mm"},
      {"goal-ranges", 4, "/goals/1/yaw_deg", "400", "a number from -360 to 360 degrees"},
      {"goal-ranges", 4, "/goals/1/deg", "200", "a number from 0 to 180 degrees"},
      {"goal-ranges", 5, "/goals/2/label", "\"I\"",
       "\"A\", \"B\", \"C\", \"D\", \"E\", \"F\", \"G\" or \"H\""},
      {"goal-ranges", 5, "/goals/2/count", "0.5", "a whole number from -2147483648 to 2147483647"},
      {"goal-ranges", 5, "/goals/2/within", "-1", "a number from 0 to 1000000"},
      {"goal-ranges", 6, "/goals/3/value", "0", "a number above 0, up to 1000000 seconds"},
      {"goal-ranges", 7, "/goals/4/value", "-1", "a whole number from 0 to 9007199254740991"},
      {"goal-ranges", 8, "/goals/5/points", "1001", "a whole number from 0 to 1000"},
      {"goal-ranges", 9, "/goals/6/names", "[]", "a list of 1 to 256"},
      {"goal-twice", 3, "/goals/0/name", "\"name\", a duplicate", "each member once"},
      {"goal-twice", 6, "/goals", "\"goals\", a duplicate", "each member once"},
      {"goal-twice", 6, "/goals", "[]", "a list of 1 to 100"},
      {"goal-types", 2, "/notes", "5", "text of 0 to 4000 bytes in UTF-8"},
      {"goal-types", 4, "/goals/0/xyz_mm", "\"400, 0, 20\"",
       "a list [x, y, z] of three numbers of mm; null"},
      {"goal-types", 4, "/goals/0/held", "\"no\"", "true or false"},
      {"goal-types", 5, "/goals/1/xyz_mm", "[400,0]",
       "a list [x, y, z] of three numbers of mm; null"},
      {"goal-types", 6, "/goals/2/box_mm", "[0,0,100,100]",
       "a list of two opposite corners [[x, y, z], [x"},
      {"goal-types", 7, "/goals/3/box_mm/1/2", "null", "a length from -100000 to 100000 mm"},
      {"goal-types", 8, "/goals/4/names", "\"red\"", "a list of 1 to 256"},
      {"goal-types", 9, "/goals/5/name", "false", "text of 1 to 40 bytes in UTF-8"},
      {"goal-types", 10, "/goals/6/points", "\"2\"", "a whole number from 0 to 1000"},
      {"goal-unknown", 2, "/note", "an unknown member \"note\"", "perhaps \"notes\" was meant"},
      {"goal-unknown", 4, "/goals/0/xyz", "an unknown member \"xyz\"",
       "perhaps \"xyz_mm\" was meant"},
      {"goal-unknown", 5, "/goals/1/point", "an unknown member \"point\"",
       "perhaps \"points\" was meant"},
      {"goal-unknown", 6, "/goals/2/bytes", "an unknown member \"bytes\"",
       "\"kind\", \"points\", \"hint\" or \"value\""},
      {"goal-unknown", 6, "/goals/2/value", "", "a whole number from 0 to 9007199254740991"},
      {"goal-unknown", 7, "/goals/3/name", "an unknown member \"name\"",
       "\"kind\", \"points\" or \"hint\""},
      {"neither-list", 1, "", "neither a robot nor a workcell, faults, goals or an exercise",
       "a robot, with \"joints\" and \"tool"},
      {"neither-other", 1, "", "neither a robot nor a workcell, faults, goals or an exercise",
       "a robot, with \"joints\" and \"tool"},
      {"not-json-comma", 10, "", "} after a comma", "a member name in double quotes"},
      {"not-json-comment", 4, "", "/", "a member name in double quotes"},
      {"not-json-cut-off", 14, "", "the end of the file", "a comma or }"},
      {"not-json-empty", 1, "", "the end of the file", "a value: a number, \"text\", true,"},
      {"not-json-nan", 7, "", "NaN", "a value: a number, \"text\", true,"},
      {"not-json-no-comma", 4, "", "\"joints\"", "a comma or }"},
      {"not-json-quote", 2, "", "a line end or control character inside text", "text on one line"},
      {"not-json-single-quotes", 8, "", "'", "a value: a number, \"text\", true,"},
      {"not-json-too-large", 7, "", "a number that is too large", "numbers up to 1e308"},
      {"robot-angular", 18, "/tool/finger_length", "", "a length above 0 mm: angular jaw"},
      {"robot-angular", 21, "/tool/limits", "[0, 200]", "an angle between the fingers fro"},
      {"robot-angular", 24, "/tool/parts/0/pivot", "", "a list [x, y, z], the hinge: ang"},
      {"robot-carousel-clash", 27, "/carousel/name", "\"elbow\", a duplicate",
       "a name that no joint has"},
      {"robot-carousel-clash", 28, "/carousel/limits", "0", "a home within the limits [10, 90"},
      {"robot-carousel-clash", 29, "/carousel/switch/mask", "2, a duplicate",
       "a bit of the reply to I that no "},
      {"robot-carousel", 27, "/carousel/label", "\"C\", a duplicate",
       "a letter \"B\" to \"H\" that nothi"},
      {"robot-carousel", 27, "/carousel/name", "\"elbow\", a duplicate",
       "a name that no joint has"},
      {"robot-carousel", 28, "/carousel/speed", "0", "a whole number from 1 to 255"},
      {"robot-carousel", 28, "/carousel/limits", "0", "a home within the limits [10, 90"},
      {"robot-carousel", 30, "/carousel/center", "[300]", "a list [x, y] of two lengths"},
      {"robot-carousel", 30, "/carousel/radius", "0", "a length above 0, up to 100000 m"},
      {"robot-carousel", 30, "/carousel/color", "16", "a whole number from 0 to 15"},
      {"robot-choices", 3, "/length_unit", "\"cm\"", "\"mm\" or \"inch\""},
      {"robot-choices", 6, "/joints/0/variable", "\"phi\"", "\"theta\" or \"d\""},
      {"robot-choices", 19, "/tool/kind", "\"suction\"", "\"parallel\" or \"angular\""},
      {"robot-comments", 17, "/joints/1/precision", "-0.2", "a number above 0, up to 1000"},
      {"robot-coupled-switch", 15, "/joints/1/switch/position",
       "a switch at position 780, coupling included", "-500 to 500, the limits in count"},
      {"robot-coupling", 27, "/coupling/5/0", "0", "a whole number from 1 to 7"},
      {"robot-coupling", 27, "/coupling/6/1", "0", "a joint's number, or minus it"},
      {"robot-coupling", 27, "/coupling/7", "5", "[joint, coupled joint], numbers "},
      {"robot-coupling", 27, "/coupling/0", "joint 1 coupled to joint 3", "joints 1 to 2"},
      {"robot-coupling", 27, "/coupling/1", "joint 2 coupled to joint 2", "two different joints"},
      {"robot-coupling", 27, "/coupling/3", "joint 1 coupled to joint 2, a duplicate",
       "each pair of joints once"},
      {"robot-coupling", 27, "/coupling/4", "joint 2 coupled to joint 1, which leads back to it",
       "couplings without a cycle"},
      {"robot-eight-joints", 4, "/joints", "a list of 8", "a list of 1 to 7"},
      {"robot-hard-home-in-region", 28, "/protected_region",
       "the tool tip at the hard home, (22.701, -74.253, 200) mm, in",
       "a region that leaves both homes "},
      {"robot-home-in-region", 28, "/protected_region",
       "the tool tip at the soft home, (300, 0, 200) mm, inside it",
       "a region that leaves both homes "},
      {"robot-home-in-region", 28, "/protected_region",
       "the tool tip at the hard home, (299.817, 0, 200) mm, inside ",
       "a region that leaves both homes "},
      {"robot-home-inch", 13, "/joints/1/d", "0", "a home within the limits [1, 4]"},
      {"robot-home-inch", 22, "/tool/home", "3", "a home within the limits [0, 2]"},
      {"robot-home-inch", 29, "/net_roll/1", "joint 2, which does not turn",
       "joints whose variable is theta"},
      {"robot-labels-twice", 12, "/joints/1/label", "\"C\", a duplicate",
       "a letter \"B\" to \"H\" that nothi"},
      {"robot-labels", 6, "/joints/0/label", "\"A\"", "a letter \"B\" to \"H\": A is the t"},
      {"robot-labels", 12, "/joints/1/label", "\"I\"", "a letter \"A\" to \"H\""},
      {"robot-labels", 19, "/tool/label", "\"B\"", "\"A\": the tool is always A"},
      {"robot-limits", 8, "/joints/0/limits", "[90, -90]", "the lower limit first"},
      {"robot-limits", 14, "/joints/1/limits", "[-100,0,100]", "a list [min, max] of two numbers"},
      {"robot-limits", 22, "/tool/home", "40", "a home within the limits [0, 30]"},
      {"robot-masks-clash", 23, "/tool/switch/mask", "1, a duplicate",
       "a bit of the reply to J that no "},
      {"robot-masks", 9, "/joints/0/switch/mask", "3", "1, 2, 4, 8, 16 or 32, or 0 for n"},
      {"robot-missing", 1, "/length_unit", "", "\"mm\" or \"inch\""},
      {"robot-missing", 8, "/joints/0/switch/mask", "", "1, 2, 4, 8, 16 or 32, or 0 for n"},
      {"robot-missing", 10, "/joints/1/precision", "", "a number above 0, up to 1000"},
      {"robot-missing", 17, "/tool/home", "", "a number from -1000000 to 100000"},
      {"robot-names", 12, "/joints/1/name", "\"base\", a duplicate",
       "a name that no other joint has"},
      {"robot-net-roll", 29, "/net_roll/4", "0", "a joint's number, or minus it"},
      {"robot-net-roll", 29, "/net_roll/5", "1.5", "a whole number from -7 to 7"},
      {"robot-net-roll", 29, "/net_roll/6", "8", "a whole number from -7 to 7"},
      {"robot-net-roll", 29, "/net_roll/1", "joint 1, a duplicate", "each joint once"},
      {"robot-net-roll", 29, "/net_roll/2", "joint 2, which does not turn",
       "joints whose variable is theta"},
      {"robot-net-roll", 29, "/net_roll/3", "joint 3", "joints 1 to 2"},
      {"robot-no-joints", 4, "/joints", "[]", "a list of 1 to 7"},
      {"robot-no-tool", 1, "/tool", "", "an object { ... }"},
      {"robot-outline", 26, "/links", "a list of 4", "a list of 3, the base's first an"},
      {"robot-outline", 27, "/links/0/color", "16", "a whole number from 0 to 15"},
      {"robot-outline", 29, "/links/2/points/0", "[\"move\",0,0]",
       "[\"move\", x, y, z] or [\"draw\", x,"},
      {"robot-outline", 29, "/links/2/points/1", "[\"jump\",1,0,0]",
       "[\"move\", x, y, z] or [\"draw\", x,"},
      {"robot-outline", 29, "/links/2/points/2/2", "\"2\"", "a length from -100000 to 100000 "},
      {"robot-parallel", 21, "/tool/limits", "-5", "an opening of 0 or more"},
      {"robot-parallel", 21, "/tool/finger_length", "60", "nothing: only angular jaws have "},
      {"robot-parallel", 24, "/tool/parts/0/side", "2", "1 or -1"},
      {"robot-parallel", 24, "/tool/parts/0/pivot", "a pivot", "nothing: only angular jaws have "},
      {"robot-period", 9, "/joints/0/switch/period", "119", "120 or more: twice the counts in"},
      {"robot-period", 15, "/joints/1/switch/period", "59", "60 or more: twice the counts in "},
      {"robot-period", 23, "/tool/switch/period", "1", "a whole number from 2 to 1000000"},
      {"robot-ranges", 8, "/joints/0/precision", "0", "a number above 0, up to 1000"},
      {"robot-ranges", 8, "/joints/0/speed", "256", "a whole number from 1 to 255"},
      {"robot-ranges", 8, "/joints/0/direction", "0", "1 or -1"},
      {"robot-ranges", 13, "/joints/1/a", "10000000", "a length from -100000 to 100000 "},
      {"robot-ranges", 15, "/joints/1/switch/mask", "64", "1, 2, 4, 8, 16 or 32, or 0 for n"},
      {"robot-ranges", 20, "/tool/speed", "0.5", "a whole number from 1 to 255"},
      {"robot-ranges", 28, "/protected_region/radius", "-1", "a length from 0 to 100000 mm"},
      {"robot-switch-at-home", 9, "/joints/0/switch/position", "0",
       "a count other than 0, or a width"},
      {"robot-switch-beyond", 15, "/joints/1/switch/position", "a switch at position -600",
       "-500 to 500, the limits in count"},
      {"robot-switch-beyond", 23, "/tool/switch/position", "a switch at position 41",
       "-80 to 40, the limits in counts"},
      {"robot-too-long", 14, "/joints/1/limits", "[0, 200000]", "lengths of up to 100000 mm"},
      {"robot-too-many-counts", 8, "/joints/0/limits",
       "90000000000 counts from the home to a limit", "up to 100000000 counts"},
      {"robot-twice", 20, "/tool/speed", "\"speed\", a duplicate", "each member once"},
      {"robot-twice", 27, "/name", "\"name\", a duplicate", "each member once"},
      {"robot-types", 2, "/name", "5", "text of 1 to 80 bytes in UTF-8"},
      {"robot-types", 7, "/joints/0/theta_deg", "\"0\"", "a number from -1000000 to 100000"},
      {"robot-types", 7, "/joints/0/d", "null", "a length from -100000 to 100000 "},
      {"robot-types", 14, "/joints/1/limits", "an object", "a list [min, max] of two numbers"},
      {"robot-types", 14, "/joints/1/speed", "true", "a whole number from 1 to 255"},
      {"robot-types", 24, "/tool/parts", "\"none\"", "a list of 0 to 16"},
      {"robot-types", 30, "/net_roll_offset_deg", "[]", "a number from -1000000 to 100000"},
      {"robot-unknown", 5, "/joints/0/alpha_deg", "", "a number from -1000000 to 100000"},
      {"robot-unknown", 7, "/joints/0/alpha", "an unknown member \"alpha\"",
       "perhaps \"alpha_deg\" was meant"},
      {"robot-unknown", 14, "/joints/1/torque", "an unknown member \"torque\"",
       "\"label\", \"name\", \"variable\", \"th"},
      {"robot-unknown", 27, "/net_role", "an unknown member \"net_role\"",
       "perhaps \"net_roll\" was meant"},
      {"workcell-camera-low", 11, "/camera/location/2", "5", "above the work surface, 5 mm"},
      {"workcell-camera-reached", 7, "/blocks/0", "a block whose top, 40 mm, reaches the camera",
       "tops below 40 mm"},
      {"workcell-missing", 4, "/workspace/y", "", "a length above 0, up to 100000 m"},
      {"workcell-missing", 8, "/blocks/1/centroid", "", "a list [x, y, z] of three length"},
      {"workcell-missing", 10, "/camera/field", "", "a list [length, width] of two le"},
      {"workcell-names", 8, "/blocks/1/name", "\"red\", a duplicate",
       "a name that no other block has"},
      {"workcell-no-blocks", 1, "/blocks", "", "a list of 0 to 256"},
      {"workcell-projection", 14, "/camera/projection", "\"fisheye\"",
       "\"orthographic\" or \"perspective\""},
      {"workcell-ranges", 4, "/workspace/x", "0", "a length above 0, up to 100000 m"},
      {"workcell-ranges", 7, "/blocks/0/size/1", "-5", "a length above 0, up to 100000 m"},
      {"workcell-ranges", 8, "/blocks/1/yaw_deg", "400", "a number from -360 to 360 degree"},
      {"workcell-ranges", 8, "/blocks/1/color", "-1", "a whole number from 0 to 15"},
      {"workcell-ranges", 12, "/camera/field/1", "0", "a length above 0, up to 100000 m"},
      {"workcell-ranges", 13, "/camera/pixels/1", "4096", "a whole number from 1 to 1000"},
      {"workcell-surface", 5, "/work_surface", "900", "less than the workspace's z, 700"},
      {"workcell-twice", 7, "/blocks/0/color", "\"color\", a duplicate", "each member once"},
      {"workcell-types", 5, "/work_surface", "false", "a length from -100000 to 100000 "},
      {"workcell-types", 6, "/surface_stalls", "1", "true or false"},
      {"workcell-types", 8, "/blocks/0/size", "[64,32]", "a list [length, width, height] o"},
      {"workcell-types", 9, "/blocks/1/centroid", "\"330, 96, 15\"",
       "a list [x, y, z] of three length"},
      {"workcell-types", 14, "/camera/pixels/0", "192.5", "a whole number from 1 to 1000"},
      {"workcell-unknown", 5, "/worksurface", "an unknown member \"worksurface\"",
       "perhaps \"work_surface\" was meant"},
      {"workcell-unknown", 7, "/blocks/0/colour", "an unknown member \"colour\"",
       "perhaps \"color\" was meant"},
      {"workcell-unknown", 7, "/blocks/0/color", "", "a whole number from 0 to 15"},
      {"workcell-unknown", 10, "/camera/location", "", "a list [x, y, z] of three length"},
      {"workcell-unknown", 11, "/camera/position", "an unknown member \"position\"",
       "perhaps \"location\" was meant"},
  };
  return table;
}

std::vector<Row> rows_of(const std::string& file) {
  std::vector<Row> result;
  for (const Row& row : rows()) {
    if (row.file == file) result.push_back(row);
  }
  return result;
}

std::vector<std::string> broken_files() {
  std::set<std::string> names;
  for (const Row& row : rows()) names.insert(row.file);
  return {names.begin(), names.end()};
}

class BrokenFile : public testing::TestWithParam<std::string> {};

TEST_P(BrokenFile, HasTheseFindings) {
  const std::string path = kFolder + GetParam() + ".json";
  const CheckResult result = check_text(test::project_file(path), path, Profile::kPaper);
  const std::vector<Row> expected = rows_of(GetParam());
  EXPECT_EQ(result.findings.size(), expected.size()) << to_text(result.findings);
  for (std::size_t i = 0; i < std::min(expected.size(), result.findings.size()); ++i) {
    const Finding& finding = result.findings[i];
    SCOPED_TRACE(to_text(finding));
    EXPECT_EQ(finding.severity, Severity::kError);
    EXPECT_EQ(finding.file, path);
    EXPECT_EQ(finding.line, expected[i].line);
    EXPECT_EQ(finding.pointer, expected[i].pointer);
    EXPECT_EQ(finding.found.empty(), expected[i].found.empty()) << "is missing";
    EXPECT_EQ(finding.found.substr(0, expected[i].found.size()), expected[i].found);
    EXPECT_EQ(finding.allowed.substr(0, expected[i].allowed.size()), expected[i].allowed);
  }
}

TEST_P(BrokenFile, HasNoValue) {
  const std::string path = kFolder + GetParam() + ".json";
  const CheckResult result = check_text(test::project_file(path), path, Profile::kPaper);
  EXPECT_FALSE(result.is_good());
  EXPECT_FALSE(result.robot || result.workcell);
  EXPECT_EQ(result.summary, "");
}

INSTANTIATE_TEST_SUITE_P(Data, BrokenFile, testing::ValuesIn(broken_files()), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (c == '-') c = '_';
  }
  return name;
});

TEST(BrokenFiles, TheTableListsAllFiles) {
  const std::string folder = std::string(XR3_SOURCE_DIR) + "/" + kFolder;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_FALSE(rows_of(entry.path().stem().string()).empty()) << entry.path();
  }
}

}  // namespace
}  // namespace xr3
