// The contents of a workcell file: workspace, work surface, blocks and camera (paper,
// Section III-B). Plain integers in micrometres and microdegrees, so that a state can hold them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/shared_vector.hpp"
#include "core/units.hpp"

namespace xr3 {

/// The box 0 <= x <= X, -Y <= y <= Y, 0 <= z <= Z in the base frame.
struct Workspace {
  Micrometres x_um = 0;
  Micrometres y_um = 0;
  Micrometres z_um = 0;
  bool operator==(const Workspace&) const = default;
};

/// Maximum number of blocks in a state. Files and calls may have fewer: kMaxFileBlocks.
inline constexpr std::size_t kMaxBlocks = 10'000;

/// A rectangular box: length along its own x, width along y, height along z. Upright unless held.
struct Block {
  std::string name;  ///< unique in a workcell
  PointUm size_um;   ///< length, width, height
  PointUm centroid_um;
  Microdegrees yaw_udeg = 0;  ///< about the vertical through the centroid, in (-180, 180] degrees
  int color = 0;              ///< palette index 0...15
  bool operator==(const Block&) const = default;
};

enum class Projection : std::uint8_t { kOrthographic, kPerspective };

/// The fixed camera, which looks straight down. Column 0 is at low x, row 0 at high y.
struct Camera {
  PointUm location_um;
  Micrometres field_x_um = 0;  ///< length of the field of view on the work surface
  Micrometres field_y_um = 0;  ///< width of the field of view on the work surface
  int pixels_x = 0;            ///< 1...2048; at most 1000 in files and calls
  int pixels_y = 0;            ///< 1...2048; at most 1000 in files and calls
  Projection projection = Projection::kOrthographic;
  bool operator==(const Camera&) const = default;
};

struct Workcell {
  std::string name;
  std::string notes;
  Workspace workspace;
  Micrometres work_surface_um = 0;  ///< z of the table's plane
  bool surface_stalls = false;      ///< a tip below the surface stalls the robot instead of warning
  SharedVector<Block> blocks;
  std::optional<Camera> camera;
  bool operator==(const Workcell&) const = default;
};

/// Blocks that are apart, or overlap, by at most this count as touching. Joints stop at whole
/// counts: with the three robots the tip is up to 0.7 mm higher or lower than a program computed,
/// and up to 0.9 mm beside it. The errors of two blocks that should touch add up.
inline constexpr Micrometres kContactToleranceUm = 2'000;

/// z of the underside and of the top of an upright block.
inline Micrometres bottom_um(const Block& block) {
  return block.centroid_um.z - block.size_um.z / 2;
}
inline Micrometres top_um(const Block& block) { return bottom_um(block) + block.size_um.z; }

/// The overlap of the footprints of two upright blocks: the shortest horizontal distance by which
/// one of them would have to move. 0 if they touch, negative if they are apart.
Micrometres footprint_overlap_um(const Block& a, const Block& b);

}  // namespace xr3
