// The rules of workcell files; declared in consistency.hpp.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/camera.hpp"
#include "core/inverse/reach.hpp"
#include "protocol/files/consistency.hpp"

namespace xr3 {
namespace {

using data::Reading;

constexpr double kTouchMm = 0.05;  ///< maximum gap at which blocks, or block and surface, touch
constexpr double kRadiansPerDegree = kPi / 180.0;

std::string block_pointer(std::size_t index) { return "/blocks/" + std::to_string(index); }

std::string length_text(double length_mm) { return data::number_json(length_mm).dump(); }

/// The footprint of a block on the table, and its bottom and top, in mm.
struct Shape {
  Eigen::Vector2d centre;
  Eigen::Vector2d along;   ///< half the length, in its direction
  Eigen::Vector2d across;  ///< half the width, in its direction
  double bottom;
  double top;

  explicit Shape(const Block& block)
      : centre(mm(block.centroid_um.x), mm(block.centroid_um.y)),
        bottom(mm(block.centroid_um.z) - mm(block.size_um.z) / 2),
        top(mm(block.centroid_um.z) + mm(block.size_um.z) / 2) {
    const double yaw = degrees(block.yaw_udeg) * kRadiansPerDegree;
    along = Eigen::Vector2d(std::cos(yaw), std::sin(yaw)) * mm(block.size_um.x) / 2;
    across = Eigen::Vector2d(-std::sin(yaw), std::cos(yaw)) * mm(block.size_um.y) / 2;
  }

  double reach(const Eigen::Vector2d& direction) const {
    return std::abs(along.dot(direction)) + std::abs(across.dot(direction));
  }
};

/// Separating axis test: the footprints overlap unless a gap exists along one of their four sides.
bool footprints_overlap(const Shape& a, const Shape& b) {
  const Eigen::Vector2d between = b.centre - a.centre;
  if (between.norm() > (a.along + a.across).norm() + (b.along + b.across).norm()) return false;
  for (const Eigen::Vector2d& side : {a.along, a.across, b.along, b.across}) {
    const Eigen::Vector2d direction = side.normalized();
    const double gap = std::abs(between.dot(direction)) - a.reach(direction) - b.reach(direction);
    if (gap > -kTouchMm) return false;
  }
  return true;
}

bool overlap(const Shape& a, const Shape& b) {
  return a.bottom < b.top - kTouchMm && b.bottom < a.top - kTouchMm && footprints_overlap(a, b);
}

bool stands_on(const Shape& upper, const Shape& lower) {
  return std::abs(upper.bottom - lower.top) <= kTouchMm && footprints_overlap(upper, lower);
}

void warn(Reading& reading, std::size_t block, std::string found, std::string allowed) {
  reading.report(Severity::kWarning, block_pointer(block), std::move(found), std::move(allowed));
}

/// Extent of a footprint in x, to find neighbours.
struct FootprintSpan {
  double low;
  double high;
  std::size_t block;
};

std::vector<FootprintSpan> spans_by_x(const std::vector<Shape>& shapes) {
  std::vector<FootprintSpan> spans;
  for (const Shape& shape : shapes) {
    const double reach = shape.reach(Eigen::Vector2d::UnitX());
    spans.push_back({shape.centre.x() - reach, shape.centre.x() + reach, spans.size()});
  }
  std::sort(spans.begin(), spans.end(),
            [](const FootprintSpan& a, const FootprintSpan& b) { return a.low < b.low; });
  return spans;
}

/// For each block: the first earlier block in the file that it overlaps, or its own index.
std::vector<std::size_t> first_overlaps(const std::vector<Shape>& shapes) {
  std::vector<std::size_t> first(shapes.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const std::vector<FootprintSpan> spans = spans_by_x(shapes);
  for (auto span = spans.begin(); span != spans.end(); ++span) {
    for (auto next = span + 1; next != spans.end() && next->low <= span->high; ++next) {
      const auto [earlier, later] = std::minmax(span->block, next->block);
      if (earlier >= first[later] || !overlap(shapes[earlier], shapes[later])) continue;
      first[later] = earlier;
    }
  }
  return first;
}

void warn_of_overlaps(const Workcell& workcell, const std::vector<Shape>& shapes,
                      Reading& reading) {
  const std::vector<std::size_t> first = first_overlaps(shapes);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) continue;
    warn(reading, i, "a block that overlaps \"" + workcell.blocks[first[i]].name + "\"",
         "blocks apart from each other");
  }
}

/// The support of a block that is on no other one.
struct Ground {
  double z;
  const char* name;
};

Ground ground_below(const Workcell& workcell, const Robot* robot, const Shape& shape) {
  const double surface = mm(workcell.work_surface_um);
  if (robot != nullptr && robot->carousel) {
    const Carousel& table = *robot->carousel;
    const bool is_over =
        (shape.centre - Eigen::Vector2d(table.x_mm, table.y_mm)).norm() <= table.radius_mm;
    if (is_over && table.height_mm > surface) return {table.height_mm, "the carousel's top"};
  }
  return {surface, "the work surface"};
}

void warn_of_height(const Workcell& workcell, const Robot* robot, const std::vector<Shape>& shapes,
                    Reading& reading) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Ground ground = ground_below(workcell, robot, shapes[i]);
    const double height = shapes[i].bottom - ground.z;
    const auto carries = [&](const Shape& lower) { return stands_on(shapes[i], lower); };
    if (height < -kTouchMm) {
      warn(reading, i, "a block that reaches " + length_text(-height) + " mm under " + ground.name,
           "a bottom at z = " + length_text(ground.z) + " or above");
    } else if (height > kTouchMm && std::none_of(shapes.begin(), shapes.end(), carries)) {
      warn(reading, i, "a block that floats " + length_text(height) + " mm above " + ground.name,
           "a bottom on the surface or on a block");
    }
  }
}

void warn_of_workspace(const Workcell& workcell, const std::vector<Shape>& shapes,
                       Reading& reading) {
  const Workspace& space = workcell.workspace;
  const Eigen::Vector2d x(1, 0);
  const Eigen::Vector2d y(0, 1);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    const bool outside = shape.centre.x() - shape.reach(x) < -kTouchMm ||
                         shape.centre.x() + shape.reach(x) > mm(space.x_um) + kTouchMm ||
                         std::abs(shape.centre.y()) + shape.reach(y) > mm(space.y_um) + kTouchMm ||
                         shape.top > mm(space.z_um) + kTouchMm;
    if (outside) {
      warn(reading, i, "a block that is partly outside the workspace",
           "x 0 to " + length_text(mm(space.x_um)) + ", y -" + length_text(mm(space.y_um)) +
               " to " + length_text(mm(space.y_um)) + ", z up to " + length_text(mm(space.z_um)) +
               " mm");
    }
  }
}

void warn_of_width(const Workcell& workcell, const Robot& robot, Reading& reading) {
  const double widest = widest_opening_mm(robot);
  for (std::size_t i = 0; i < workcell.blocks.size(); ++i) {
    const Block& block = workcell.blocks[i];
    const double narrow = mm(std::min(block.size_um.x, block.size_um.y));
    if (narrow < widest) continue;
    warn(reading, i, "a block " + length_text(narrow) + " mm wide",
         "less than " + length_text(std::round(widest * 1000) / 1000) +
             " mm, the jaws' widest opening");
  }
}

// Without a closed form of the inverse kinematics, a block takes about a tenth of a second.
void warn_of_reach(const Workcell& workcell, const Robot& robot, std::size_t first,
                   Reading& reading) {
  constexpr std::size_t kMostWhenSlow = 100;
  const Reach reach(robot);
  const std::size_t count = workcell.blocks.size();
  const std::size_t end = reach.is_quick() ? count : std::min(count, first + kMostWhenSlow);
  for (std::size_t i = first; i < end; ++i) {
    if (reach.has_grasp(workcell.blocks[i])) continue;
    warn(reading, i, "a block out of reach",
         "a centre where " + robot.name + " can hold it from straight above");
  }
  if (end == count) return;
  reading.report(Severity::kWarning, "/blocks",
                 std::to_string(count - end) + " blocks whose reach was not checked",
                 std::to_string(kMostWhenSlow) + " blocks: for " + robot.name + " each takes long");
}

void check_surface(const Workcell& workcell, Reading& reading) {
  if (!reading.is_sound("/work_surface") || !reading.is_sound("/workspace/z")) return;
  if (workcell.work_surface_um < workcell.workspace.z_um) return;
  reading.refuse(
      "/work_surface", length_text(mm(workcell.work_surface_um)),
      "less than the workspace's z, " + length_text(mm(workcell.workspace.z_um)) + " mm");
}

/// The camera must be above the work surface; in perspective, above every block, too.
void check_camera(const Workcell& workcell, Reading& reading) {
  if (!workcell.camera || !reading.is_sound("/camera")) return;
  const double height = mm(workcell.camera->location_um.z);
  const bool surface_known = reading.is_sound("/work_surface");
  if (surface_known && workcell.camera->location_um.z <= workcell.work_surface_um) {
    reading.refuse("/camera/location/2", length_text(height),
                   "above the work surface, " + length_text(mm(workcell.work_surface_um)) + " mm");
  }
  if (workcell.camera->projection != Projection::kPerspective) return;
  for (std::size_t i = 0; i < workcell.blocks.size(); ++i) {
    if (!reading.is_sound(block_pointer(i))) continue;
    const Shape shape(workcell.blocks[i]);
    if (shape.top < height) continue;
    reading.refuse(block_pointer(i),
                   "a block whose top, " + length_text(shape.top) + " mm, reaches the camera",
                   "tops below " + length_text(height) + " mm");
  }
}

/// Bounds the time that a picture takes.
void check_camera_rows(const Workcell& workcell, Reading& reading) {
  const std::int64_t rows = camera_rows(workcell, workcell.blocks);
  if (rows <= kMaxCameraRows) return;
  reading.refuse(
      "/blocks",
      "blocks that take " + std::to_string(rows) +
          " rows of the camera's image, each row counted for each block",
      "at most " + std::to_string(kMaxCameraRows) + ": fewer or smaller blocks, or fewer pixels");
}

}  // namespace

double widest_opening_mm(const Robot& robot) {
  const Tool& tool = robot.tool;
  if (tool.kind == ToolKind::kParallel) return tool.drive.max;
  return 2 * tool.finger_length_mm * std::sin(tool.drive.max / 2 * kRadiansPerDegree);
}

void check_workcell(const Workcell& workcell, const Robot* robot, std::size_t first_reach,
                    Reading& reading) {
  data::check_names(workcell.blocks.all(), "/blocks", "block", reading);
  check_surface(workcell, reading);
  check_camera(workcell, reading);
  if (reading.has_errors()) return;
  check_camera_rows(workcell, reading);
  if (reading.has_errors() || !reading.wants_warnings()) return;
  std::vector<Shape> shapes;
  for (const Block& block : workcell.blocks) shapes.emplace_back(block);
  warn_of_overlaps(workcell, shapes, reading);
  warn_of_height(workcell, robot, shapes, reading);
  warn_of_workspace(workcell, shapes, reading);
  if (robot == nullptr) return;
  warn_of_width(workcell, *robot, reading);
  warn_of_reach(workcell, *robot, first_reach, reading);
}

}  // namespace xr3
