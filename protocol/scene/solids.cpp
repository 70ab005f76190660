#include "protocol/scene/solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/scene/triangulation.hpp"

namespace xr3 {
namespace {

constexpr double kToleranceMm = 0.6;  ///< coordinates in files are rounded
constexpr double kMinScale = 0.3;     ///< minimum ratio of the two ends of a frustum
constexpr double kRodWidthMm = 4;

using Loop = std::vector<Eigen::Vector3d>;  ///< a closed stroke without its repeated last point

/// Two ends with corresponding corners.
struct Prism {
  Loop bottom;
  Loop top;
};

/// Two unit vectors in the plane of a loop.
struct PlaneAxes {
  Eigen::Vector3d e;
  Eigen::Vector3d f;
};

Eigen::Vector3d middle(const Loop& loop) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : loop) sum += p;
  return sum / static_cast<double>(loop.size());
}

/// nullopt if the points are on one line.
std::optional<PlaneAxes> plane_axes(const Loop& loop) {
  const Eigen::Vector3d e = (loop[1] - loop[0]).normalized();
  Eigen::Vector3d furthest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : loop) {
    const Eigen::Vector3d v = p - loop[0];
    const Eigen::Vector3d across = v - e.dot(v) * e;
    if (across.norm() > furthest.norm()) furthest = across;
  }
  if (e.isZero() || furthest.isZero()) return std::nullopt;
  return PlaneAxes{e, furthest.normalized()};
}

bool is_loop(const Stroke& stroke) {
  return stroke.size() > 3 && (stroke.front() - stroke.back()).norm() < kToleranceMm;
}

/// Whether the vector leads out of the plane.
bool leads_out(const PlaneAxes& plane, const Eigen::Vector3d& v) {
  return v.norm() - std::hypot(plane.e.dot(v), plane.f.dot(v)) >= kToleranceMm;
}

/// Whether loop b is loop a shifted out of its plane and possibly scaled.
bool is_shifted(const Loop& a, const Loop& b) {
  if (a.size() != b.size()) return false;
  const Eigen::Vector3d from = middle(a);
  const Eigen::Vector3d to = middle(b);
  const double scale = (b[0] - to).norm() / (a[0] - from).norm();
  if (!(scale > kMinScale && scale < 1 / kMinScale)) return false;
  const std::optional<PlaneAxes> plane = plane_axes(a);
  if (!plane || !leads_out(*plane, to - from)) return false;
  return std::equal(a.begin(), a.end(), b.begin(), [&](const auto& p, const auto& q) {
    return (to + scale * (p - from) - q).norm() < 2 * kToleranceMm;
  });
}

/// Takes each loop with the first later one that is the other end of its prism.
std::vector<Prism> prisms_of(const std::vector<Stroke>& strokes) {
  std::vector<Loop> loops;
  for (const Stroke& stroke : strokes)
    if (is_loop(stroke)) loops.emplace_back(stroke.begin(), stroke.end() - 1);
  std::vector<Prism> prisms;
  for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
    const auto other = std::find_if(loop + 1, loops.end(), [&](const Loop& each) {
      return !loop->empty() && is_shifted(*loop, each);
    });
    if (other == loops.end()) continue;
    prisms.push_back({*loop, std::exchange(*other, {})});
  }
  return prisms;
}

/// The ends of a square rod around a line.
Prism rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d u = (to - from).unitOrthogonal() * (kRodWidthMm / 2);
  const Eigen::Vector3d v = (to - from).normalized().cross(u);
  const auto end = [&](const Eigen::Vector3d& p) {
    return Loop{p + u + v, p - u + v, p - u - v, p + u - v};
  };
  return {end(from), end(to)};
}

void add_rods(std::vector<Prism>& prisms, const Stroke& stroke) {
  for (std::size_t i = 1; i < stroke.size(); ++i)
    if (stroke[i - 1] != stroke[i]) prisms.push_back(rod(stroke[i - 1], stroke[i]));
}

/// Scales a prism about the middle of its bounding box, so that the box is smaller on each side.
Prism drawn_in(Prism prism, double inset_mm) {
  Eigen::AlignedBox3d box;
  for (const Loop* loop : {&prism.bottom, &prism.top})
    for (const Eigen::Vector3d& p : *loop) box.extend(p);
  const Eigen::Array3d sizes = box.sizes().array();
  const Eigen::Array3d factors = (sizes > 2 * inset_mm).select(1 - 2 * inset_mm / sizes, 1);
  const Eigen::Vector3d center = box.center();
  for (Loop* loop : {&prism.bottom, &prism.top})
    for (Eigen::Vector3d& p : *loop) p = center + ((p - center).array() * factors).matrix();
  return prism;
}

std::vector<Eigen::Vector2d> flat(const Loop& loop, const PlaneAxes& plane) {
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3d& p : loop)
    points.emplace_back(plane.e.dot(p - loop[0]), plane.f.dot(p - loop[0]));
  return points;
}

/// Twice the area of a polygon; positive if it is counterclockwise.
double turning(const std::vector<Eigen::Vector2d>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& next = polygon[(i + 1) % polygon.size()];
    sum += p.x() * next.y() - p.y() * next.x();
  }
  return sum;
}

/// The faces of a prism whose bottom is counterclockwise seen from its top.
void add_faces(std::vector<Triangle>& faces, const Prism& prism,
               const std::vector<Eigen::Vector2d>& polygon) {
  const auto& [bottom, top] = prism;
  for (const auto& [i, j, k] : triangulated(polygon)) {
    faces.push_back({bottom[i], bottom[k], bottom[j]});
    faces.push_back({top[i], top[j], top[k]});
  }
  for (std::size_t i = 0; i < bottom.size(); ++i) {
    const std::size_t next = (i + 1) % bottom.size();
    faces.push_back({bottom[i], bottom[next], top[next]});
    faces.push_back({bottom[i], top[next], top[i]});
  }
}

void add_prism(std::vector<Triangle>& faces, Prism prism) {
  std::optional<PlaneAxes> plane = plane_axes(prism.bottom);
  if (!plane) return;
  const Eigen::Vector3d up = middle(prism.top) - middle(prism.bottom);
  if (plane->e.cross(plane->f).dot(up) < 0) std::swap(plane->e, plane->f);
  if (turning(flat(prism.bottom, *plane)) < 0) {
    std::reverse(prism.bottom.begin(), prism.bottom.end());
    std::reverse(prism.top.begin(), prism.top.end());
  }
  add_faces(faces, prism, flat(prism.bottom, *plane));
}

}  // namespace

Solid solid_of(std::vector<Stroke> strokes, double inset_mm, BareStrokes bare) {
  std::vector<Prism> prisms = prisms_of(strokes);
  const bool has_prisms = !prisms.empty();
  for (const Stroke& stroke : strokes)
    if (!has_prisms || (bare == BareStrokes::kRods && !is_loop(stroke))) add_rods(prisms, stroke);
  Solid solid;
  for (Prism& prism : prisms) add_prism(solid.faces, drawn_in(std::move(prism), inset_mm));
  solid.strokes = std::move(strokes);
  return solid;
}

}  // namespace xr3
