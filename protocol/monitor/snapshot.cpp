#include "protocol/monitor/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/step.hpp"
#include "core/switches.hpp"
#include "protocol/line/rhino_reply.hpp"

namespace xr3 {
namespace {

constexpr std::array<double, 10> kPowersOfTen = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double kWhole = 9007199254740992.0;  // 2^53: doubles above are whole numbers
constexpr int kDigitalLines = 8;
constexpr int kAuxiliaryPorts = 2;

/// A model and a snapshot of it, with values that several members need.
struct StateView {
  const Model& model;
  const Snapshot& snapshot;
  Positions positions;

  const State& state() const { return snapshot.state; }
  const MotorState& motor(int index) const { return state().motor(index); }
  Counts position(int index) const { return positions[static_cast<std::size_t>(index)]; }
};

Json blocked_json(Blocked blocked) {
  switch (blocked) {
    case Blocked::kNo: return nullptr;
    case Blocked::kLimit: return "limit";
    case Blocked::kBlock: return "block";
  }
  return nullptr;
}

Json stall_json(Stall stall) {
  switch (stall) {
    case Stall::kNo: return nullptr;
    case Stall::kProtectedRegion: return "protected_region";
    case Stall::kWorkSurface: return "work_surface";
  }
  return nullptr;
}

Json bits_json(unsigned bits, int count) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back((bits >> static_cast<unsigned>(i) & 1U) != 0);
  return list;
}

bool is_linear(const Model& model, int index) {
  if (index == model.tool_index()) return model.robot().tool.kind == ToolKind::kParallel;
  return model.robot().joints[static_cast<std::size_t>(index)].variable == JointVariable::kD;
}

/// The first members of both joints and tool.
Json counters_json(const StateView& look, int index) {
  const bool linear = is_linear(look.model, index);
  const double value = look.model.variable(index, look.position(index));
  return {{"label", std::string(1, look.model.motor(index).drive.label)},
          {"count", look.motor(index).count},
          {"error", look.motor(index).error},
          {"value", rounded(value, linear ? kMmDecimals : kDegreeDecimals)},
          {"unit", linear ? "mm" : "deg"}};
}

/// `moving`: the motor will make counts without new input.
void add_motion(const StateView& look, int index, Json& members) {
  const MotorState& motor = look.motor(index);
  members["speed"] = motor.speed;
  members["switch"] = motor.switch_closed;
  members["moving"] = look.state().stall == Stall::kNo && is_running(motor);
  members["blocked"] = blocked_json(motor.blocked);
}

Json joint_json(const StateView& look, int index) {
  Json joint = counters_json(look, index);
  add_motion(look, index, joint);
  return joint;
}

Json joints_json(const StateView& look) {
  Json joints = Json::array();
  for (int k = 0; k < look.model.joint_count(); ++k) joints.push_back(joint_json(look, k));
  return joints;
}

/// In row-major order; the columns are the normal, sliding and approach vectors.
Json rotation_json(const StateView& look) {
  const Transform pose = tool_transform(look.model, look.positions);
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation.push_back(rounded(pose(row, column), kMatrixDecimals));
    }
  }
  return rotation;
}

/// The tip in mm, then the approach vector scaled by the roll.
Json configuration_json(const StateView& look) {
  const ToolConfiguration w = tool_configuration(look.model, look.positions);
  Json configuration = point_json(tool_tip(look.model, look.positions));
  for (int i = 3; i < 6; ++i) configuration.push_back(rounded(w(i), kMatrixDecimals));
  return configuration;
}

Json holding_json(const State& state) {
  if (!state.held) return nullptr;
  return state.blocks[state.held->block].name;
}

Json tool_json(const StateView& look) {
  const int index = look.model.tool_index();
  Json tool = counters_json(look, index);
  tool["opening_mm"] = rounded(opening_mm(look.model, look.position(index)), kMmDecimals);
  add_motion(look, index, tool);
  tool["xyz_mm"] = point_json(tool_tip(look.model, look.positions));
  tool["rotation"] = rotation_json(look);
  tool["configuration"] = configuration_json(look);
  tool["net_roll_deg"] = rounded(net_roll_deg(look.model, look.positions), kDegreeDecimals);
  tool["holding"] = holding_json(look.state());
  return tool;
}

Json lying_json(const Block& block) {
  return {{"name", block.name},
          {"xyz_mm", point_json(block.centroid_um)},
          {"yaw_deg", rounded(degrees(block.yaw_udeg), kDegreeDecimals)},
          {"held", false}};
}

/// A held block moves with the tool; its yaw is that of its length axis, seen from above.
Json held_json(const StateView& look, std::size_t index) {
  const Transform pose = block_pose(look.model, look.state(), index);
  const double yaw = std::atan2(pose(1, 0), pose(0, 0)) * 180.0 / kPi;
  const PointUm centroid{micrometres(pose(0, 3)), micrometres(pose(1, 3)), micrometres(pose(2, 3))};
  return {{"name", look.state().blocks[index].name},
          {"xyz_mm", point_json(centroid)},
          {"yaw_deg", rounded(yaw, kDegreeDecimals)},
          {"held", true}};
}

Json blocks_json(const StateView& look) {
  const State& state = look.state();
  Json blocks = Json::array();
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    const bool is_held = state.held && state.held->block == i;
    blocks.push_back(is_held ? held_json(look, i) : lying_json(state.blocks[i]));
  }
  return blocks;
}

/// The values of the replies to I and J, without kReplyBase (32).
Json switches_json(const StateView& look) {
  const auto code = [&look](char inquiry) {
    return switch_code(switch_bits(look.model, look.state(), inquiry), look.model.profile());
  };
  return {{"I", code('I')}, {"J", code('J')}};
}

Json io_json(const InputOutput& io) {
  return {{"inputs", bits_json(io.inputs, kDigitalLines)},
          {"outputs", bits_json(io.outputs, kDigitalLines)},
          {"aux", bits_json(io.auxiliary, kAuxiliaryPorts)}};
}

}  // namespace

const std::vector<std::string>& state_members() {
  static const std::vector<std::string> names = {"clock",    "joints",   "tool",   "blocks",
                                                 "switches", "io",       "moving", "stalled",
                                                 "enabled",  "model_rev"};
  return names;
}

Json clock_json(ClockMode mode, Rate rate) {
  return {{"mode", mode == ClockMode::kReal ? "real" : "manual"},
          {"rate", static_cast<double>(rate.millionths) / 1e6}};
}

Json point_json(const PointUm& point) {
  return {rounded(mm(point.x), kMmDecimals), rounded(mm(point.y), kMmDecimals),
          rounded(mm(point.z), kMmDecimals)};
}

Json state_json(const Model& model, const Snapshot& snapshot) {
  const State& state = snapshot.state;
  const StateView look{model, snapshot, positions(model, state.motors)};
  return {{"clock", clock_json(snapshot.mode, snapshot.rate)},
          {"joints", joints_json(look)},
          {"tool", tool_json(look)},
          {"blocks", blocks_json(look)},
          {"switches", switches_json(look)},
          {"io", io_json(state.io)},
          {"moving", !is_at_rest(model, state)},
          {"stalled", stall_json(state.stall)},
          {"enabled", state.enabled},
          {"model_rev", snapshot.model_rev}};
}

Json chosen(const Json& members, const Fields& fields) {
  if (!fields) return members;
  Json picked = Json::object();
  for (const std::string& name : *fields) {
    if (members.contains(name)) picked[name] = members.at(name);
  }
  return picked;
}

// A whole number divided by a power of ten is the double nearest to that decimal number, so it is
// printed with exactly these digits. Adding 0 turns -0 into 0.
double rounded(double value, int decimals) {
  if (std::isnan(value)) return 0.0;
  const double most = std::numeric_limits<double>::max();
  const double finite = std::clamp(value, -most, most);
  const double scale = kPowersOfTen.at(static_cast<std::size_t>(decimals));
  if (std::abs(finite) >= kWhole / scale) return finite;
  return std::round(finite * scale) / scale + 0.0;
}

}  // namespace xr3
