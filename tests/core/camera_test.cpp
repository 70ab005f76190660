// Compares the overhead camera with the pictures in tests/golden (XR3_UPDATE_GOLDEN=1 rewrites
// them), with a slow reference that tests for every pixel whether its centre lies in a hull, and
// with the area, centre and direction that follow from each block's size and yaw.
#include "core/camera.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <set>
#include <string>

#include "core/grasp.hpp"
#include "core/home.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::model_of;
using test::positions_at;
using test::project_file;
using test::rhino;
using test::robot_named;
using test::state_at;
using test::workcell_named;

ModelPtr model_with(const Workcell& workcell, const std::string& robot = "rhino-xr3") {
  return std::make_shared<const Model>(robot_named(robot), workcell, Profile::kPaper);
}

/// The Rhino holds its first block above the table, hand and block tilted.
State holding_tilted(const Model& model) {
  State state = state_at(model, {{'F', 90}, {'E', 300}, {'D', -400}, {'C', 200}, {'B', 48}});
  state.held = Held{0, 0, positions_at(model, {{'E', 449}, {'D', -625}})};
  return state;
}

// --- Pictures as text.

std::string to_pbm(const Image& image) {
  std::string text =
      "P1\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n";
  for (int row = 0; row < image.height(); ++row) {
    for (const bool pixel : image.row(row)) text += pixel ? '1' : '0';
    text += '\n';
  }
  return text;
}

void expect_golden(const Image& image, const std::string& name) {
  const std::string path = "tests/golden/" + name + ".pbm";
  if (std::getenv("XR3_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(std::string(XR3_SOURCE_DIR) + "/" + path) << to_pbm(image);
  }
  EXPECT_TRUE(to_pbm(image) == project_file(path)) << path << " shows another picture";
}

struct Scene {
  const char* robot;
  const char* workcell;
};

constexpr Scene kScenes[] = {{"rhino-xr3", "rhino-xr3"},
                             {"rhino-xr3", "rhino-hundred"},
                             {"adept-one", "adept-one"},
                             {"intelledex-660", "intelledex-660"}};

TEST(Camera, GoldenPicturesOfDefaultWorkcells) {
  for (const Scene& scene : kScenes) {
    Workcell workcell = workcell_named(scene.workcell);
    for (const Projection projection : {Projection::kOrthographic, Projection::kPerspective}) {
      workcell.camera->projection = projection;
      const ModelPtr model = model_with(workcell, scene.robot);
      const bool is_straight = projection == Projection::kOrthographic;
      expect_golden(camera_image(*model, initial_state(*model)),
                    std::string(scene.workcell) + (is_straight ? "" : "-perspective"));
    }
  }
}

TEST(Camera, GoldenPicturesOfATiltedBlock) {
  Workcell workcell = workcell_named("rhino-xr3");
  workcell.blocks.edit().resize(1);
  for (const Projection projection : {Projection::kOrthographic, Projection::kPerspective}) {
    workcell.camera->projection = projection;
    const ModelPtr model = model_with(workcell);
    const bool is_straight = projection == Projection::kOrthographic;
    expect_golden(camera_image(*model, holding_tilted(*model)),
                  is_straight ? "held-tilted" : "held-tilted-perspective");
  }
}

// --- The slow reference: a point lies in the hull of the corners if it is on the inner side of
// every line through two of them that has all corners on one side. A point on the line is inside if
// the hull is to the right of the line, or above a horizontal line.

struct Corner {
  double x;  ///< whole numbers throughout: exact up to 2^53
  double y;
  auto operator<=>(const Corner&) const = default;
};

double side(const Corner& a, const Corner& b, const Corner& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool lies_in_hull(const Corner& p, const std::set<Corner>& corners) {
  bool has_line = false;
  for (const Corner& a : corners) {
    for (const Corner& b : corners) {
      const bool borders = a != b && std::all_of(corners.begin(), corners.end(),
                                                 [&](Corner c) { return side(a, b, c) >= 0; });
      if (!borders) continue;
      has_line = true;
      const double where = side(a, b, p);
      const bool is_low_edge = b.y < a.y || (b.y == a.y && b.x > a.x);
      if (where < 0 || (where == 0 && !is_low_edge)) return false;
    }
  }
  return has_line;
}

/// Corners on the work surface in micrometres, computed in a different order: rotation first.
std::set<Corner> shadow(const Model& model, const State& state, std::size_t block) {
  const Camera& camera = *model.workcell().camera;
  const Transform pose = block_pose(model, state, block);
  const PointUm& size = state.blocks[block].size_um;
  std::set<Corner> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector4d p =
        pose * Eigen::Vector4d((i & 1 ? 0.5 : -0.5) * mm(size.x), (i & 2 ? 0.5 : -0.5) * mm(size.y),
                               (i & 4 ? 0.5 : -0.5) * mm(size.z), 1);
    double x = std::round(p.x() * 1000);
    double y = std::round(p.y() * 1000);
    if (camera.projection == Projection::kPerspective) {
      const auto eye_x = static_cast<double>(camera.location_um.x);
      const auto eye_y = static_cast<double>(camera.location_um.y);
      const auto eye_z = static_cast<double>(camera.location_um.z);
      const double depth = std::max(eye_z - std::round(p.z() * 1000), 1000.0);
      const double height = eye_z - static_cast<double>(model.workcell().work_surface_um);
      x = eye_x + std::round((x - eye_x) * height / depth);
      y = eye_y + std::round((y - eye_y) * height / depth);
    }
    corners.insert({x, y});
  }
  return corners;
}

/// Lengths times 2 * pixels, so that centres are whole numbers, too.
bool reference_pixel(const Camera& camera, const std::set<Corner>& corners, int column, int row) {
  const double scale_x = 2.0 * camera.pixels_x;
  const double scale_y = 2.0 * camera.pixels_y;
  const auto field_x = static_cast<double>(camera.field_x_um);
  const auto field_y = static_cast<double>(camera.field_y_um);
  const Corner centre{scale_x * static_cast<double>(camera.location_um.x) -
                          camera.pixels_x * field_x + (2 * column + 1) * field_x,
                      scale_y * static_cast<double>(camera.location_um.y) +
                          camera.pixels_y * field_y - (2 * row + 1) * field_y};
  std::set<Corner> scaled;
  for (const Corner& corner : corners) scaled.insert({corner.x * scale_x, corner.y * scale_y});
  return lies_in_hull(centre, scaled);
}

Image reference_image(const Model& model, const State& state) {
  const Camera& camera = *model.workcell().camera;
  Image image(camera.pixels_x, camera.pixels_y);
  for (std::size_t block = 0; block < state.blocks.size(); ++block) {
    const std::set<Corner> corners = shadow(model, state, block);
    for (int row = 0; row < image.height(); ++row) {
      for (int column = 0; column < image.width(); ++column) {
        if (reference_pixel(camera, corners, column, row)) image.fill(row, column, column + 1);
      }
    }
  }
  return image;
}

// --- Random scenes. With small numbers and right angles, corners and edges often hit pixel
// centres.

int in_range(int low, int high) { return *rc::gen::inRange(low, high + 1); }

Camera some_camera() {
  Camera camera;
  camera.pixels_x = in_range(1, 24);
  camera.pixels_y = in_range(1, 24);
  camera.field_x_um = camera.pixels_x * 2 * in_range(1, 900);
  camera.field_y_um = camera.pixels_y * 2 * in_range(1, 900);
  camera.location_um = {in_range(-20, 20) * 100, in_range(-20, 20) * 100, in_range(20, 100) * 1000};
  camera.projection = *rc::gen::element(Projection::kOrthographic, Projection::kPerspective);
  return camera;
}

Block some_block(const Camera& camera) {
  const int step = *rc::gen::element(1, 7, 250);
  const auto within = [&](Micrometres field) {
    return static_cast<Micrometres>(in_range(0, static_cast<int>(field) / step)) * step;
  };
  Block block;
  block.size_um = {1 + within(camera.field_x_um), 1 + within(camera.field_y_um), in_range(1, 9000)};
  if (in_range(0, 1) == 0) block.size_um = {2 * step, camera.field_y_um, 4000};
  block.centroid_um = {camera.location_um.x - camera.field_x_um / 2 + within(camera.field_x_um),
                       camera.location_um.y - camera.field_y_um / 2 + within(camera.field_y_um),
                       in_range(0, 12000)};
  block.yaw_udeg = *rc::gen::element(0, 90, 180, -90, in_range(-179, 180)) * 1'000'000;
  return block;
}

Workcell some_workcell() {
  Workcell workcell = test::bare_workcell();
  workcell.camera = some_camera();
  const int blocks = in_range(1, 3);
  for (int i = 0; i < blocks; ++i) workcell.blocks.edit().push_back(some_block(*workcell.camera));
  return workcell;
}

RC_GTEST_PROP(Camera, EveryPixelEqualsTheReference, ()) {
  const ModelPtr model = model_with(some_workcell());
  const State state = initial_state(*model);
  RC_ASSERT(to_pbm(camera_image(*model, state)) == to_pbm(reference_image(*model, state)));
}

RC_GTEST_PROP(Camera, EveryPixelOfAHeldBlockEqualsTheReference, ()) {
  Workcell workcell = workcell_named("rhino-xr3");
  workcell.blocks.edit().resize(1);
  workcell.camera->field_x_um = workcell.camera->field_y_um = 90'000;
  workcell.camera->pixels_x = in_range(1, 24);
  workcell.camera->pixels_y = in_range(1, 24);
  workcell.camera->projection =
      *rc::gen::element(Projection::kOrthographic, Projection::kPerspective);
  ModelPtr model = model_with(workcell);
  State state = holding_tilted(*model);
  state.motor(model->index_of('C')).count = in_range(-900, 900);
  state.motor(model->index_of('B')).count = in_range(-300, 300);
  const Transform pose = block_pose(*model, state, 0);
  workcell.camera->location_um.x = micrometres(pose(0, 3)) + in_range(-20'000, 20'000);
  workcell.camera->location_um.y = micrometres(pose(1, 3)) + in_range(-20'000, 20'000);
  model = model_with(workcell);
  RC_ASSERT(to_pbm(camera_image(*model, state)) == to_pbm(reference_image(*model, state)));
}

RC_GTEST_PROP(Camera, RowsAndPixelsEqualThoseOfTheImage, ()) {
  const ModelPtr model = model_with(some_workcell());
  const State state = initial_state(*model);
  const Image image = camera_image(*model, state);
  const int row = in_range(0, image.height() - 1);
  const int column = in_range(0, image.width() - 1);
  RC_ASSERT(camera_row(*model, state, row).row(0) == image.row(row));
  RC_ASSERT(camera_pixel(*model, state, column, row) == image.at(column, row));
}

// --- Individual rules.

/// A camera above 80 x 60 mm, 10 mm per pixel, with the lower left corner of the field at (0, 0).
Workcell eight_by_six() {
  Workcell workcell = test::bare_workcell();
  workcell.camera = Camera{{40'000, 30'000, 500'000}, 80'000, 60'000, 8, 6, {}};
  return workcell;
}

Image picture_of(const Block& block, Workcell workcell = eight_by_six()) {
  workcell.blocks = {block};
  const ModelPtr model = model_with(workcell);
  return camera_image(*model, initial_state(*model));
}

Block box(Micrometres low_x, Micrometres high_x, Micrometres low_y, Micrometres high_y) {
  return {"box",
          {high_x - low_x, high_y - low_y, 10'000},
          {(low_x + high_x) / 2, (low_y + high_y) / 2, 5'000},
          0,
          9};
}

int area(const Image& image) {
  int pixels = 0;
  for (int row = 0; row < image.height(); ++row) {
    const std::vector<bool> line = image.row(row);
    pixels += static_cast<int>(std::count(line.begin(), line.end(), true));
  }
  return pixels;
}

TEST(Camera, LowXIsLeftAndHighYIsUp) {
  EXPECT_EQ(to_pbm(picture_of(box(10'000, 30'000, 40'000, 50'000))),
            "P1\n8 6\n00000000\n01100000\n00000000\n00000000\n00000000\n00000000\n");
}

TEST(Camera, LowEdgesAreIncludedAndHighEdgesExcluded) {
  EXPECT_EQ(to_pbm(picture_of(box(15'000, 35'000, 25'000, 45'000))),
            "P1\n8 6\n00000000\n00000000\n01100000\n01100000\n00000000\n00000000\n");
  EXPECT_EQ(to_pbm(picture_of(box(15'002, 35'002, 25'002, 45'002))),
            "P1\n8 6\n00000000\n00110000\n00110000\n00000000\n00000000\n00000000\n");
}

TEST(Camera, ClipsBlocksAtTheEdgeOfTheField) {
  EXPECT_EQ(area(picture_of(box(-50'000, 900'000, -70'000, 800'000))), 48);
  EXPECT_EQ(area(picture_of(box(-50'000, 20'000, 40'000, 90'000))), 4);
  EXPECT_EQ(area(picture_of(box(80'000, 90'000, 0, 60'000))), 0);
  EXPECT_EQ(area(picture_of(box(0, 80'000, -20'000, 0))), 0);
}

TEST(Camera, AShapeWithoutAreaHasNoPixels) {
  EXPECT_EQ(area(picture_of(box(15'000, 15'000, 0, 60'000))), 0);
  EXPECT_EQ(area(picture_of(box(0, 80'000, 25'000, 25'000))), 0);
  EXPECT_EQ(area(picture_of(box(15'000, 15'000, 25'000, 25'000))), 0);
}

TEST(Camera, PerspectiveMagnifiesNearBlocks) {
  Workcell workcell = eight_by_six();
  workcell.camera->projection = Projection::kPerspective;
  Block block = box(30'000, 50'000, 20'000, 40'000);
  block.centroid_um.z = 245'000;  // its top is half way up to the camera: twice as large
  EXPECT_EQ(area(picture_of(block, workcell)), 4 * 4);
  workcell.work_surface_um = 125'000;  // and the table is nearer: one and a half times
  EXPECT_EQ(area(picture_of(block, workcell)), 3 * 3);
  block.size_um.z = 2;
  block.centroid_um.z = 125'000;
  EXPECT_EQ(picture_of(block, workcell), picture_of(block));
}

TEST(Camera, OnlyPerspectiveHidesBlocksBehindTheCamera) {
  Workcell workcell = eight_by_six();
  workcell.camera->projection = Projection::kPerspective;
  Block block = box(35'000, 40'000, 25'000, 30'000);
  block.centroid_um.z = 505'000;
  EXPECT_EQ(area(picture_of(block, workcell)), 0);
  EXPECT_EQ(picture_of(block), picture_of(box(35'000, 40'000, 25'000, 30'000)));
  block.centroid_um.z = 499'000;  // reaches past the lens: hides its quarter of the field
  EXPECT_EQ(area(picture_of(block, workcell)), 12);
}

TEST(Camera, TheLargestImageIsExactAtItsCorners) {
  Workcell workcell = eight_by_six();
  workcell.camera->pixels_x = workcell.camera->pixels_y = 2048;
  EXPECT_EQ(area(picture_of(box(0, 80'000, 0, 60'000), workcell)), 2048 * 2048);
  const Image half = picture_of(box(0, 40'000, 0, 60'000), workcell);
  EXPECT_EQ(area(half), 1024 * 2048);
  EXPECT_TRUE(half.at(1023, 2047));
  EXPECT_FALSE(half.at(1024, 2047));
}

TEST(Camera, CountsTheRowsThatBlocksTake) {
  Workcell workcell = eight_by_six();
  const auto rows = [&](const std::vector<Block>& blocks) { return camera_rows(workcell, blocks); };
  const Block small = box(15'000, 35'000, 25'000, 45'000);
  const Block all = box(-50'000, 900'000, -70'000, 800'000);
  Block turned = box(0, 80'000, 29'000, 31'000);
  turned.yaw_udeg = 90'000'000;
  EXPECT_EQ(rows({}), 0);
  EXPECT_EQ(rows({small}), 2);
  EXPECT_EQ(rows({turned}), 6);
  EXPECT_EQ(rows({small, all, box(0, 80'000, -20'000, 0)}), 2 + 6 + 0);
  workcell.camera->pixels_y = 2048;
  EXPECT_EQ(rows({all, all}), 2 * 2048);
  workcell.camera->projection = Projection::kPerspective;
  Block high = box(30'000, 50'000, 20'000, 40'000);
  high.centroid_um.z = 245'000;  // half way up to the camera
  workcell.camera->pixels_y = 6;
  EXPECT_EQ(rows({high}), 4);
  workcell.camera.reset();
  EXPECT_EQ(rows({all}), 0);
}

// --- Measurements of a vision exercise.

struct Blob {
  double area = 0;
  double x = 0;  ///< mm in the base frame
  double y = 0;
  double angle_deg = 0;  ///< of the long axis
};

Blob measure(const Image& image, const Camera& camera) {
  const double width = mm(camera.field_x_um) / camera.pixels_x;
  const double height = mm(camera.field_y_um) / camera.pixels_y;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      if (!image.at(column, row)) continue;
      const double x = mm(camera.location_um.x - camera.field_x_um / 2) + (column + 0.5) * width;
      const double y = mm(camera.location_um.y + camera.field_y_um / 2) - (row + 0.5) * height;
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
  }
  const double x = sx / n;
  const double y = sy / n;
  const double twice = std::atan2(2 * (sxy / n - x * y), (sxx / n - x * x) - (syy / n - y * y));
  return {n * width * height, x, y, twice / 2 * 180 / kPi};
}

/// Angle between two undirected lines: 0...90.
double angle_between_deg(double a, double b) { return std::abs(std::remainder(a - b, 180.0)); }

TEST(Camera, ImagesOfDefaultBlocksHaveTheSizesOfTheFile) {
  for (const Scene& scene : kScenes) {
    Workcell workcell = workcell_named(scene.workcell);
    const Camera camera = *workcell.camera;
    const double pixel = mm(camera.field_x_um) / camera.pixels_x;
    for (const Block& block : workcell_named(scene.workcell).blocks) {
      const Blob blob = measure(picture_of(block, workcell), camera);
      const double length = mm(block.size_um.x);
      const double width = mm(block.size_um.y);
      EXPECT_NEAR(blob.area, length * width, 0.35 * pixel * (length + width)) << block.name;
      EXPECT_NEAR(blob.x, mm(block.centroid_um.x), 0.5 * pixel) << block.name;
      EXPECT_NEAR(blob.y, mm(block.centroid_um.y), 0.5 * pixel) << block.name;
      const double tolerance_deg = length > 40 ? 2.0 : 6.0;
      EXPECT_LT(angle_between_deg(blob.angle_deg, degrees(block.yaw_udeg)), tolerance_deg)
          << scene.workcell << " " << block.name;
    }
  }
}

}  // namespace
}  // namespace xr3
