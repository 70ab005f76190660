#include "tests/support/models.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3::test {
namespace {

constexpr Micrometres kOutOfReach = -100'000'000;

template <class Value, class Load>
const Value& cached(std::map<std::string, Value>& cache, std::string_view folder,
                    std::string_view name, Load load) {
  const std::string key(name);
  auto found = cache.find(key);
  if (found == cache.end()) {
    const std::string path = "data/" + std::string(folder) + "/" + key + ".json";
    found = cache.emplace(key, load(project_file(path), path)).first;
  }
  return found->second;
}

ModelPtr make_roomy(Profile profile) {
  Robot robot = robot_named("rhino-xr3");
  robot.protected_region = {};
  Workcell workcell = bare_workcell();
  workcell.work_surface_um = kOutOfReach;
  return std::make_shared<const Model>(std::move(robot), std::move(workcell), profile);
}

Joint odd_joint(int index, int joints) {
  Joint joint;
  joint.name = "joint " + std::to_string(index + 1);
  joint.variable = index % 3 == 1 ? JointVariable::kD : JointVariable::kTheta;
  joint.dh = {17.0 * index - 40.0, 31.5 + 7.0 * index, 12.25 * (index % 2), 90.0 - 23.0 * index};
  joint.drive.label = static_cast<char>('A' + joints - index);
  joint.drive.precision = 0.1 + 0.05 * index;
  joint.drive.home = joint.variable == JointVariable::kD ? joint.dh.d_mm : joint.dh.theta_deg;
  joint.drive.min = joint.drive.home - 2000 * joint.drive.precision;
  joint.drive.max = joint.drive.home + 2000 * joint.drive.precision;
  joint.drive.speed_counts_per_s = 100 + index;
  joint.drive.direction = index % 2 == 0 ? 1 : -1;
  joint.drive.microswitch = {20, 0, {}, {}};
  return joint;
}

}  // namespace

std::string project_file(std::string_view path) {
  std::ifstream file(std::string(XR3_SOURCE_DIR) + "/" + std::string(path), std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + std::string(path));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const Robot& robot_named(std::string_view name) {
  static std::map<std::string, Robot> cache;
  return cached(cache, "robots", name, load_robot);
}

const Workcell& workcell_named(std::string_view name) {
  static std::map<std::string, Workcell> cache;
  return cached(cache, "workcells", name, load_workcell);
}

Workcell bare_workcell() {
  Workcell workcell;
  workcell.name = "bare";
  workcell.workspace = {600'000, 500'000, 700'000};
  return workcell;
}

ModelPtr rhino(Profile profile) {
  static const ModelPtr paper = model_of(robot_named("rhino-xr3"), Profile::kPaper);
  static const ModelPtr mark3 = model_of(robot_named("rhino-xr3"), Profile::kMark3);
  return profile == Profile::kPaper ? paper : mark3;
}

ModelPtr roomy_rhino(Profile profile) {
  static const ModelPtr paper = make_roomy(Profile::kPaper);
  static const ModelPtr mark3 = make_roomy(Profile::kMark3);
  return profile == Profile::kPaper ? paper : mark3;
}

ModelPtr model_of(Robot robot, Profile profile) {
  return std::make_shared<const Model>(std::move(robot), bare_workcell(), profile);
}

Robot on_slide(Robot robot) {
  Joint slide;
  slide.name = "slide";
  slide.variable = JointVariable::kD;
  slide.dh = {0, 0, 0, 90};
  slide.drive = {'G', 0.5, -250, 250, 0, 120, 1, {-40, 16, {}, {}}};
  robot.mount = DhRow{0, 0, 0, -90};
  robot.joints.insert(robot.joints.begin(), slide);
  for (Coupling& c : robot.couplings) c = {c.joint + 1, c.coupled + 1, c.sign};
  for (RollTerm& term : robot.net_roll) ++term.joint;
  robot.links.insert(robot.links.begin(), Outline{});
  return robot;
}

Robot odd_arm(int joints) {
  Robot robot;
  robot.name = "odd arm";
  for (int index = 0; index < joints; ++index) robot.joints.push_back(odd_joint(index, joints));
  robot.tool.drive = {'A', 0.5, 0, 40, 20, 60, 1, {10, 0, {}, {}}};
  return robot;
}

}  // namespace xr3::test
