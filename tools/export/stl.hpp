// Meshes as binary STL, in metres.
#pragma once

#include <string>
#include <vector>

#include "protocol/scene/links.hpp"
#include "tools/export/exported.hpp"

namespace xr3 {

/// The binary STL of these faces.
std::string to_stl(const std::vector<Triangle>& faces);

/// The path of the mesh of a link, relative to the robot's file.
std::string mesh_path(const SceneLink& link);

/// Adds a mesh for each link with faces.
void add_meshes(std::vector<ExportedFile>& files, const std::vector<SceneLink>& links);

}  // namespace xr3
