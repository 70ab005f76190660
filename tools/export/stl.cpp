#include "tools/export/stl.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>

#include "tools/export/numbers.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kHeaderBytes = 80;

template <class Unsigned>
void add_little_endian(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    bytes += static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
}

void add_floats(std::string& bytes, const Eigen::Vector3d& values) {
  for (const double value : values)
    add_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

}  // namespace

std::string to_stl(const std::vector<Triangle>& faces) {
  std::string bytes = "made by xr3 export, in metres";
  bytes.resize(kHeaderBytes, ' ');
  add_little_endian(bytes, static_cast<std::uint32_t>(faces.size()));
  for (const Triangle& face : faces) {
    add_floats(bytes, (face[1] - face[0]).cross(face[2] - face[0]).normalized());
    for (const Eigen::Vector3d& corner : face) add_floats(bytes, kMetresPerMm * corner);
    add_little_endian(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string mesh_path(const SceneLink& link) { return "meshes/" + link.name + ".stl"; }

void add_meshes(std::vector<ExportedFile>& files, const std::vector<SceneLink>& links) {
  for (const SceneLink& link : links)
    if (!link.solid.faces.empty()) files.push_back({mesh_path(link), to_stl(link.solid.faces)});
}

}  // namespace xr3
