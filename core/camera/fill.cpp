#include "core/camera/fill.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3 {
namespace {

/// Holds products of three lengths, or of two lengths and two numbers of pixels, with a margin.
__extension__ using Wide = __int128;

template <class Integer>
struct Quotient {
  Integer floor;
  Integer rest;  ///< 0 <= rest < divisor
};

/// Precondition: divisor > 0.
template <class Integer>
Quotient<Integer> divide(Integer number, Integer divisor) {
  assert(divisor > 0);
  const Integer quotient = number / divisor;
  const Integer rest = number % divisor;
  return rest < 0 ? Quotient<Integer>{quotient - 1, rest + divisor}
                  : Quotient<Integer>{quotient, rest};
}

/// Whether the number and the sum of two such numbers fit into 64 bits.
bool is_narrow(Wide number) {
  constexpr Wide kLimit = Wide{1} << 62;
  return -kLimit < number && number < kLimit;
}

Wide floor_of(Wide number, Wide divisor) {
  if (!is_narrow(number) || !is_narrow(divisor)) return divide(number, divisor).floor;
  return divide(static_cast<std::int64_t>(number), static_cast<std::int64_t>(divisor)).floor;
}

/// A quotient that is linear in the row: number / divisor in the first row, and `step` more in the
/// numerator in each row.
struct Column {
  Wide number;
  Wide step;
  Wide divisor;

  bool is_narrow_for(int rows) const {
    return is_narrow(number) && is_narrow(step * rows) && is_narrow(divisor);
  }
};

/// Calls take(row, floor of the quotient, clamped to 0...width) for each row. Divides once for the
/// first quotient and once for the step; updates quotient and rest from row to row.
template <class Integer, class Take>
void follow(const Column& column, int rows, int width, const Take& take) {
  const auto divisor = static_cast<Integer>(column.divisor);
  auto [floor, rest] = divide(static_cast<Integer>(column.number), divisor);
  const auto step = divide(static_cast<Integer>(column.step), divisor);
  for (int row = 0; row < rows; ++row) {
    take(row, static_cast<int>(std::clamp<Integer>(floor, 0, width)));
    floor += step.floor;
    rest += step.rest;
    if (rest < divisor) continue;
    rest -= divisor;
    ++floor;
  }
}

/// Twice the signed area of the triangle a, b, c: above 0 if c lies to the left of the directed
/// line from a to b, with x right and y up.
Wide turn(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
  return static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
}

/// The border of the hull from its lowest corner up to its highest.
struct Chain {
  std::array<SurfacePoint, kBoxCorners> corners;
  std::size_t count = 0;
};

/// The chain on one side of the hull. `side` +1: the border at low x, with every corner to its
/// right; -1: the one at high x.
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

// The centre of row r lies at y = location.y + field_y / 2 - (2 r + 1) field_y / (2 pixels_y).
// Returns the last row whose centre is at y or above, clamped to first...last.
int row_at_or_above(const Camera& camera, Micrometres y, int first, int last) {
  const Wide pixels = camera.pixels_y;
  const Wide number = 2 * pixels * (camera.location_um.y - y) + (pixels - 1) * camera.field_y_um;
  return static_cast<int>(
      std::clamp<Wide>(floor_of(number, 2 * Wide{camera.field_y_um}), first, last));
}

}  // namespace

int rows_between(const Camera& camera, Micrometres low_y, Micrometres high_y) {
  const int last = camera.pixels_y - 1;
  return row_at_or_above(camera, low_y, -1, last) - row_at_or_above(camera, high_y, -1, last);
}

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

int CameraFill::last_row_above(Micrometres y) const {
  return row_at_or_above(camera_, y, first_row_ - 1, first_row_ + image_.height() - 1);
}

// Calls take(row, column) for each row whose centre has low.y <= y < high.y. The column is the
// first one whose centre is not left of the edge from low to high, clamped to the image's width.
template <class Take>
void CameraFill::walk(const SurfacePoint& low, const SurfacePoint& high, Take take) const {
  const int begin = last_row_above(high.y) + 1;
  const int rows = last_row_above(low.y) + 1 - begin;
  if (rows <= 0) return;
  const Wide width = camera_.pixels_x;
  const Wide height = camera_.pixels_y;
  const Wide rise = high.y - low.y;
  const Wide drift = high.x - low.x;
  const Wide below = 2 * height * (camera_.location_um.y - low.y) +
                     (height - 1 - 2 * static_cast<Wide>(begin)) * camera_.field_y_um;
  const Wide right = 2 * width * (low.x - camera_.location_um.x) + (width - 1) * camera_.field_x_um;
  const Wide divisor = 2 * camera_.field_x_um * height * rise;
  // The column is a quotient rounded up: adding divisor - 1 allows rounding down.
  const Column column{right * height * rise + width * drift * below + divisor - 1,
                      -2 * width * drift * camera_.field_y_um, divisor};
  const auto take_row = [&](int row, int pixel) { take(begin - first_row_ + row, pixel); };
  if (column.is_narrow_for(rows)) {
    follow<std::int64_t>(column, rows, camera_.pixels_x, take_row);
  } else {
    follow<Wide>(column, rows, camera_.pixels_x, take_row);
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
