// Rasterizes convex shapes on the work surface with exact integer arithmetic: only their corners
// are rounded. Independent of blocks and projections.
#pragma once

#include <array>
#include <compare>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// A point of the work surface in base coordinates, at most 10^15 micrometres from the camera's
/// location. Ordered by y, then by x.
struct SurfacePoint {
  Micrometres y = 0;
  Micrometres x = 0;
  auto operator<=>(const SurfacePoint&) const = default;
};

/// The number of rows of the camera's image whose centres have low_y <= y < high_y.
int rows_between(const Camera& camera, Micrometres low_y, Micrometres high_y);

inline constexpr std::size_t kBoxCorners = 8;
using BoxCorners = std::array<SurfacePoint, kBoxCorners>;

/// Rows first_row, first_row + 1, ... of a camera's image.
class CameraFill {
 public:
  /// Precondition: 0 <= first_row and first_row + rows <= camera.pixels_y.
  CameraFill(const Camera& camera, int first_row, int rows);
  /// All rows, drawn onto an image of the camera's size.
  CameraFill(const Camera& camera, Image onto);

  /// Sets the pixels whose centres lie in the convex hull of the corners. Edges at low x and y
  /// belong to it, those at high x and y do not.
  void add(BoxCorners corners);

  /// Moves the image out; no add() may follow.
  Image take_image() { return std::move(image_); }

 private:
  template <class Take>
  void walk(const SurfacePoint& low, const SurfacePoint& high, Take take) const;
  /// The last row whose centre is at y or above, clamped to our rows and the row above them.
  int last_row_above(Micrometres y) const;

  Camera camera_;
  int first_row_;
  Image image_;
  std::vector<int> begins_;  ///< per row: the first column of the shape being added
};

}  // namespace xr3
