// A robot as a tree of links for the programs of others: each with the name of its frame, its place
// in the frame of its parent, the motion that a motor gives it, and its solid. Lengths are in mm.
//
// The flow through the folder: scene_links() takes a model and makes its links, from the base to
// the fingers of the tool, then the carousel. Frames move as joint variables do: the frame of a
// link turns or slides with its joint, and the constant rest of its Denavit-Hartenberg row is the
// place of the next link. relative_pose() gives the frame at a value of the variable. The solids
// are from outlines of the robot file (or the stick figure of a robot without them), whose strokes
// core/drawing/strokes.hpp finds. solids.hpp makes prisms of them, with triangles from
// triangulation.hpp. tools/export writes the links as files; the messages of protocol/foxglove have
// the same names of frames. Nothing here depends on a state, JSON or files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/kinematics.hpp"
#include "protocol/scene/solids.hpp"

namespace xr3 {

enum class LinkMotion : std::uint8_t { kFixed, kTurns, kSlides };

struct SceneLink {
  std::string name;  ///< `base`, `link_F` for the joint with this label, `tool`, `finger_1`, ...
  int parent = -1;   ///< index of a link before it; -1 for the base
  Transform place;   ///< the frame in that of the parent while the variable is 0
  LinkMotion motion = LinkMotion::kFixed;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< in its frame
  int motor = -1;    ///< index of the model's motor with the variable; -1 if it is fixed
  double ratio = 1;  ///< degrees or mm of motion per degree or mm of the variable
  int color = 0;     ///< palette index 0...15
  Solid solid = {};  ///< in its frame; empty for a frame without a body

  bool is_fixed() const { return motion == LinkMotion::kFixed; }
};

/// The links of a robot, parents first.
std::vector<SceneLink> scene_links(const Model& model);

/// The frame of a link in the frame of its parent, at a value of its motor's variable in degrees
/// or mm.
Transform relative_pose(const SceneLink& link, double variable);

}  // namespace xr3
