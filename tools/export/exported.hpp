// A robot as files for other programs: URDF for ROS and viewers, MJCF for MuJoCo; both with meshes
// of its solids.
//
// The flow through the folder: scene_links() of protocol/scene makes links with frames, motions and
// solids. joint.hpp derives the joint of each, in metres and radians: its name, limits, speed, and
// the joint that it mimics. inertia.hpp guesses mass and inertia from the box around a solid.
// urdf.cpp lists the links and their joints; mjcf.cpp nests them as bodies, with actuators and the
// soft home. stl.hpp writes the meshes, which both forms name. A joint is a joint variable of the
// robot, not a motor: motors that move several joints cannot be expressed in either form.
// Values only; cli/commands/export.cpp writes the files, into a folder of their own.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"

namespace xr3 {

struct ExportedFile {
  std::string path;  ///< relative, with slashes
  std::string bytes;
};

/// NAME.urdf, which is the first, and the meshes.
std::vector<ExportedFile> to_urdf(const Model& model, const std::string& name);

/// NAME.xml, which is the first, and the meshes.
std::vector<ExportedFile> to_mjcf(const Model& model, const std::string& name);

}  // namespace xr3
