#include "protocol/monitor/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/step.hpp"
#include "core/switches.hpp"
#include "protocol/line/rhino_reply.hpp"
#include "protocol/monitor/message.hpp"

namespace xr3 {
namespace {

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

Json bits_json(unsigned bits, int count) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back((bits >> static_cast<unsigned>(i) & 1U) != 0);
  return list;
}

/// The members that both joints and tool begin with.
Json counters_json(const StateView& view, int index) {
  const bool linear = view.model.is_length(index);
  const double value = view.model.variable(index, view.position(index));
  return {{"label", std::string(1, view.model.motor(index).drive.label)},
          {"count", view.motor(index).count},
          {"error", view.motor(index).error},
          {"value", rounded(value, linear ? kMmDecimals : kDegreeDecimals)},
          {"unit", linear ? "mm" : "deg"}};
}

/// Adds `moving`: whether the motor will make counts without new input.
void add_motion(const StateView& view, int index, Json& members) {
  const MotorState& motor = view.motor(index);
  members["speed"] = motor.speed;
  members["switch"] = motor.switch_closed;
  members["moving"] = view.state().stall == Stall::kNo && is_running(motor);
  members["blocked"] = blocked_json(motor.blocked);
}

Json joint_json(const StateView& view, int index) {
  Json joint = counters_json(view, index);
  add_motion(view, index, joint);
  return joint;
}

/// The joints of the arm from the base, then the carousel.
Json joints_json(const StateView& view) {
  Json joints = Json::array();
  for (int k = 0; k < view.model.joint_count(); ++k) joints.push_back(joint_json(view, k));
  if (view.model.carousel()) joints.push_back(joint_json(view, view.model.carousel_index()));
  return joints;
}

/// The rotation in row-major order; the columns are the normal, sliding and approach vectors.
Json rotation_json(const StateView& view) {
  const Transform pose = tool_transform(view.model, view.positions);
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation.push_back(rounded(pose(row, column), kMatrixDecimals));
    }
  }
  return rotation;
}

/// The tool configuration: the tip in mm, then the approach vector scaled by the roll.
Json configuration_json(const StateView& view) {
  const ToolConfiguration w = tool_configuration(view.model, view.positions);
  Json configuration = point_json(tool_tip(view.model, view.positions));
  for (int i = 3; i < 6; ++i) configuration.push_back(rounded(w(i), kMatrixDecimals));
  return configuration;
}

Json holding_json(const State& state) {
  if (!state.held) return nullptr;
  return state.blocks[state.held->block].name;
}

Json tool_json(const StateView& view) {
  const int index = view.model.tool_index();
  Json tool = counters_json(view, index);
  tool["opening_mm"] = rounded(opening_mm(view.model, view.position(index)), kMmDecimals);
  add_motion(view, index, tool);
  tool["xyz_mm"] = point_json(tool_tip(view.model, view.positions));
  tool["rotation"] = rotation_json(view);
  tool["configuration"] = configuration_json(view);
  tool["net_roll_deg"] = rounded(net_roll_deg(view.model, view.positions), kDegreeDecimals);
  tool["holding"] = holding_json(view.state());
  return tool;
}

Json lying_json(const Block& block) {
  return {{"name", block.name},
          {"xyz_mm", point_json(block.centroid_um)},
          {"yaw_deg", rounded(degrees(block.yaw_udeg), kDegreeDecimals)},
          {"held", false}};
}

/// A held block, which moves with the tool; its yaw is that of its length axis, seen from above.
Json held_json(const StateView& view, std::size_t index) {
  const Transform pose = block_pose(view.model, view.state(), index);
  const double yaw = std::atan2(pose(1, 0), pose(0, 0)) * 180.0 / kPi;
  const PointUm centroid{micrometres(pose(0, 3)), micrometres(pose(1, 3)), micrometres(pose(2, 3))};
  return {{"name", view.state().blocks[index].name},
          {"xyz_mm", point_json(centroid)},
          {"yaw_deg", rounded(yaw, kDegreeDecimals)},
          {"held", true}};
}

Json blocks_json(const StateView& view) {
  const State& state = view.state();
  Json blocks = Json::array();
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    const bool is_held = state.held && state.held->block == i;
    blocks.push_back(is_held ? held_json(view, i) : lying_json(state.blocks[i]));
  }
  return blocks;
}

/// The values of the replies to I and J, without kReplyBase (32).
Json switches_json(const StateView& view) {
  const auto code = [&view](char inquiry) {
    return switch_code(switch_bits(view.model, view.state(), inquiry), view.model.profile());
  };
  return {{"I", code('I')}, {"J", code('J')}};
}

Json io_json(const InputOutput& io) {
  return {{"inputs", bits_json(io.inputs, kDigitalLines)},
          {"outputs", bits_json(io.outputs, kDigitalLines)},
          {"aux", bits_json(io.auxiliary, kAuxiliaryPorts)}};
}

/// The member `device`. Precondition: there is a device. Without one, `state` does not have the
/// member.
Json device_json(const StateView& view) {
  assert(view.snapshot.device);
  const DeviceStatus& device = *view.snapshot.device;
  return {{"path", device.path},
          {"open", device.is_open},
          {"engaged", device.is_engaged},
          {"bytes_out", device.bytes_out},
          {"bytes_in", device.bytes_in}};
}

struct StateMember {
  const char* name;
  Json (*value)(const StateView&);
};
constexpr std::array<StateMember, 11> kMembers = {{
    {"clock",
     [](const StateView& v) {
       Json clock = clock_json(v.snapshot.mode, v.snapshot.rate);
       if (v.snapshot.is_in_past) clock["past"] = true;
       if (v.snapshot.is_frozen) clock["frozen"] = true;
       return clock;
     }},
    {"joints", joints_json},
    {"tool", tool_json},
    {"blocks", blocks_json},
    {"switches", switches_json},
    {"io", [](const StateView& v) { return io_json(v.state().io); }},
    {"moving", [](const StateView& v) { return Json(!is_at_rest(v.model, v.state())); }},
    {"stalled", [](const StateView& v) { return stall_json(v.state().stall); }},
    {"enabled", [](const StateView& v) { return Json(v.state().enabled); }},
    {"model_rev", [](const StateView& v) { return Json(v.snapshot.model_rev); }},
    {"device", device_json},
}};

bool has_member(const StateMember& member, const Snapshot& snapshot) {
  return member.value != device_json || snapshot.device;
}

}  // namespace

Json stall_json(Stall stall) {
  switch (stall) {
    case Stall::kNo: return nullptr;
    case Stall::kProtectedRegion: return "protected_region";
    case Stall::kWorkSurface: return "work_surface";
  }
  return nullptr;
}

const std::vector<std::string>& state_members() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const StateMember& member : kMembers) all.emplace_back(member.name);
    return all;
  }();
  return names;
}

Json state_json(const Model& model, const Snapshot& snapshot, const Fields& fields) {
  const StateView view{model, snapshot, positions(model, snapshot.state.motors)};
  Json members = Json::object();
  for (const std::string& name : fields ? *fields : state_members()) {
    const auto* member = std::find_if(kMembers.begin(), kMembers.end(),
                                      [&](const StateMember& each) { return each.name == name; });
    if (member == kMembers.end() || members.contains(name)) continue;
    if (has_member(*member, snapshot)) members[name] = member->value(view);
  }
  return members;
}

MemberTexts StateEncoder::encode(const Model& model, const Snapshot& snapshot) {
  const StateView view{model, snapshot, positions(model, snapshot.state.motors)};
  MemberTexts texts;
  for (const StateMember& member : kMembers) {
    if (!has_member(member, snapshot)) continue;
    const bool is_list = member.value == blocks_json;
    texts.emplace_back(
        member.name, is_list ? blocks_text(model, snapshot) : monitor::text_of(member.value(view)));
  }
  return texts;
}

std::string StateEncoder::blocks_text(const Model& model, const Snapshot& snapshot) {
  const State& state = snapshot.state;
  texts_.resize(state.blocks.size());
  std::string list = "[";
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    if (i >= blocks_.size() || blocks_[i] != state.blocks[i])
      texts_[i] = monitor::text_of(lying_json(state.blocks[i]));
    if (i > 0) list += ',';
    const bool is_held = state.held && state.held->block == i;
    list += is_held
                ? monitor::text_of(held_json({model, snapshot, positions(model, state.motors)}, i))
                : texts_[i];
  }
  blocks_ = state.blocks;
  return list + "]";
}

Json chosen(const Json& members, const Fields& fields) {
  if (!fields) return members;
  Json picked = Json::object();
  for (const std::string& name : *fields) {
    if (members.contains(name)) picked[name] = members.at(name);
  }
  return picked;
}

}  // namespace xr3
