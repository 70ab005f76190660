// Convex shapes on the work surface into pixels by exact integer arithmetic: no rounding after the
// corners' own. It knows nothing of blocks or of how their corners came to lie there.
#pragma once

#include <array>
#include <compare>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// A point of the work surface in base coordinates; within 10^15 micrometres of the camera's.
/// The order is upwards, and to the right among equally high ones.
struct SurfacePoint {
  Micrometres y = 0;
  Micrometres x = 0;
  auto operator<=>(const SurfacePoint&) const = default;
};

inline constexpr std::size_t kBoxCorners = 8;
using BoxCorners = std::array<SurfacePoint, kBoxCorners>;

/// Rows first_row, first_row + 1, ... of what a camera sees.
class CameraFill {
 public:
  /// 0 <= first_row, first_row + rows <= camera.pixels_y.
  CameraFill(const Camera& camera, int first_row, int rows);
  /// All rows, drawn onto a picture of the camera's size.
  CameraFill(const Camera& camera, Image onto);

  /// Sets the pixels whose centres lie in the convex hull of the corners: low edges in, high edges out.
  void add(BoxCorners corners);

  /// The picture, once nothing more is added.
  Image take_image() { return std::move(image_); }

 private:
  template <class Take>
  void walk(const SurfacePoint& low, const SurfacePoint& high, Take take) const;
  int last_row_above(Micrometres y) const;

  Camera camera_;
  int first_row_;
  Image image_;
  std::vector<int> begins_;  ///< of each row: its first column in the shape that is being added
};

}  // namespace xr3
