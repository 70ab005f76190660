#include "core/camera_fill.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3 {
namespace {

/// Holds products of three lengths, or of two lengths and two numbers of pixels, with a margin.
__extension__ using Wide = __int128;

struct Quotient {
  Wide floor;
  Wide rest;  ///< 0 <= rest < divisor
};

/// Precondition: divisor > 0.
Quotient divide(Wide number, Wide divisor) {
  assert(divisor > 0);
  const Wide quotient = number / divisor;
  const Wide rest = number % divisor;
  return rest < 0 ? Quotient{quotient - 1, rest + divisor} : Quotient{quotient, rest};
}

/// > 0 if c lies to the left of the directed line from a to b, with x right and y up.
Wide turn(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
  return static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
}

/// The border of the hull from its lowest corner up to its highest.
struct Chain {
  std::array<SurfacePoint, kBoxCorners> corners;
  std::size_t count = 0;
};

/// side +1: the border at low x, with every corner to its right; -1: the one at high x.
Chain chain(const BoxCorners& sorted, int side) {
  Chain hull;
  for (const SurfacePoint& corner : sorted) {
    while (hull.count >= 2 &&
           side * turn(hull.corners[hull.count - 2], hull.corners[hull.count - 1], corner) >= 0) {
      --hull.count;
    }
    hull.corners[hull.count++] = corner;
  }
  return hull;
}

int clamped(Wide value, int low, int high) {
  return static_cast<int>(std::clamp<Wide>(value, low, high));
}

}  // namespace

CameraFill::CameraFill(const Camera& camera, int first_row, int rows)
    : camera_(camera),
      first_row_(first_row),
      image_(camera.pixels_x, rows),
      begins_(static_cast<std::size_t>(rows)) {
  assert(first_row >= 0 && first_row + rows <= camera.pixels_y);
}

CameraFill::CameraFill(const Camera& camera, Image onto)
    : camera_(camera),
      first_row_(0),
      image_(std::move(onto)),
      begins_(static_cast<std::size_t>(image_.height())) {}

// The centre of row r lies at y = location.y + field_y / 2 - (2 r + 1) field_y / (2 pixels_y).
// Returns the lowest row whose centre is at y or above, clamped to our rows and the row above them.
int CameraFill::last_row_above(Micrometres y) const {
  const Wide pixels = camera_.pixels_y;
  const Wide number = 2 * pixels * (camera_.location_um.y - y) + (pixels - 1) * camera_.field_y_um;
  return clamped(divide(number, 2 * camera_.field_y_um).floor, first_row_ - 1,
                 first_row_ + image_.height() - 1);
}

// Calls take(row, column) for each row whose centre has low.y <= y < high.y. The column is the
// first one whose centre is not left of the edge from low to high, clamped to the image's width. It
// is a quotient that is linear in the row: one division gives the first quotient, one the step, and
// then quotient and rest are updated from row to row.
template <class Take>
void CameraFill::walk(const SurfacePoint& low, const SurfacePoint& high, Take take) const {
  const int begin = last_row_above(high.y) + 1;
  const int end = last_row_above(low.y) + 1;
  if (begin >= end) return;
  const Wide width = camera_.pixels_x;
  const Wide height = camera_.pixels_y;
  const Wide rise = high.y - low.y;
  const Wide drift = high.x - low.x;
  const Wide below = 2 * height * (camera_.location_um.y - low.y) +
                     (height - 1 - 2 * static_cast<Wide>(begin)) * camera_.field_y_um;
  const Wide right = 2 * width * (low.x - camera_.location_um.x) + (width - 1) * camera_.field_x_um;
  const Wide divisor = 2 * camera_.field_x_um * height * rise;
  // The column is a quotient rounded up: adding divisor - 1 allows rounding down.
  Quotient column = divide(right * height * rise + width * drift * below + divisor - 1, divisor);
  const Quotient step = divide(-2 * width * drift * camera_.field_y_um, divisor);
  for (int row = begin; row < end; ++row) {
    take(row - first_row_, clamped(column.floor, 0, camera_.pixels_x));
    column.floor += step.floor;
    column.rest += step.rest;
    if (column.rest < divisor) continue;
    column.rest -= divisor;
    ++column.floor;
  }
}

void CameraFill::add(BoxCorners corners) {
  std::sort(corners.begin(), corners.end());
  const Chain left = chain(corners, +1);
  const Chain right = chain(corners, -1);
  for (std::size_t i = 1; i < left.count; ++i) {
    walk(left.corners[i - 1], left.corners[i],
         [&](int row, int column) { begins_[static_cast<std::size_t>(row)] = column; });
  }
  for (std::size_t i = 1; i < right.count; ++i) {
    walk(right.corners[i - 1], right.corners[i], [&](int row, int column) {
      image_.fill(row, begins_[static_cast<std::size_t>(row)], column);
    });
  }
}

}  // namespace xr3
