// 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
// down elsewhere, and look again.
//
//     build/6_find_and_pick [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.

#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <vector>

#include "robot.hpp"

const double kDegrees = 180 / std::acos(-1.0);

// The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
// of 2 mm. Each byte of the picture has six pixels.
const int kPixels = 192;
const int kRowBytes = kPixels / 6;

const int kOpen = -16;      // count of A with open jaws
const int kShut = 64;       // count of A with closed jaws
const double kZ = 20;       // height of the largest block's centre, mm
const double kAbove = 100;  // height above it for approach and departure, mm

const Counts kHome{{'F', 0}, {'E', 0}, {'D', 0}, {'C', 0}, {'B', 0}, {'A', 0}};

/// A place on the table: x and y in mm, and the direction of a block's long side in degrees.
struct Place {
  double x, y, angle;
};

/// Sums over the pixels of one patch, to compute its centre and angle.
struct Patch {
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// Rows from the top; true where the camera sees a block.
using Picture = std::vector<std::vector<bool>>;

/// Requests the picture. The leftmost of six pixels is the highest bit, and 32 is added to each
/// byte.
Picture look(Robot& robot) {
  robot.send("A**");
  const std::vector<unsigned char> bytes = robot.read(kPixels * kRowBytes);
  Picture picture(kPixels, std::vector<bool>(kPixels));
  for (int row = 0; row < kPixels; ++row) {
    for (int column = 0; column < kPixels; ++column) {
      const int six = bytes[row * kRowBytes + column / 6] - 32;
      picture[row][column] = (six >> (5 - column % 6) & 1) == 1;
    }
  }
  return picture;
}

/// Adds this pixel and all pixels connected to it to the patch and removes them from the picture,
/// so that none is counted twice.
void collect(Picture& picture, int row, int column, Patch& patch) {
  if (row < 0 || row >= kPixels || column < 0 || column >= kPixels) return;
  if (!picture[row][column]) return;
  picture[row][column] = false;
  const double x = 290 - 192 + 2 * (column + 0.5);
  const double y = 0 + 192 - 2 * (row + 0.5);
  patch.n += 1;
  patch.x += x;
  patch.y += y;
  patch.xx += x * x;
  patch.yy += y * y;
  patch.xy += x * y;
  collect(picture, row, column + 1, patch);
  collect(picture, row, column - 1, patch);
  collect(picture, row + 1, column, patch);
  collect(picture, row - 1, column, patch);
}

/// The centre of a patch is the average of its pixels. The long side has the direction of their
/// largest spread, the principal axis of inertia.
Place measure(const Patch& patch) {
  const double x = patch.x / patch.n;
  const double y = patch.y / patch.n;
  const double xx = patch.xx / patch.n - x * x;
  const double yy = patch.yy / patch.n - y * y;
  const double xy = patch.xy / patch.n - x * y;
  const double angle = std::atan2(2 * xy, xx - yy) / 2 * kDegrees;
  return {x, y, angle < 0 ? angle + 180 : angle};
}

Place find_largest(Robot& robot) {
  Picture picture = look(robot);
  Patch largest;
  int patches = 0;
  for (int row = 0; row < kPixels; ++row) {
    for (int column = 0; column < kPixels; ++column) {
      Patch patch;
      collect(picture, row, column, patch);
      if (patch.n > 0) ++patches;
      if (patch.n > largest.n) largest = patch;
    }
  }
  std::cout << "blocks in the picture: " << patches << "\n";
  if (patches == 0) throw std::runtime_error("the camera sees no block: is one on the table?");
  const Place found = measure(largest);
  std::cout << "the largest is at x " << found.x << ", y " << found.y << " mm, turned "
            << found.angle << " degrees\n";
  return found;
}

/// Inverse kinematics: moves the tool, pointing down, to a place at height z. Seen from the side,
/// upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third side leads from the
/// shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and 9.5 mm nearer to
/// the base. Each motor sets the slope of one link, independently of the others.
void go_to(Robot& robot, Place place, double z) {
  const double out = std::hypot(place.x, place.y) - 9.5;
  const double up = z + 168.3 - 260.4;
  const double base = std::atan2(place.y, place.x) * kDegrees;
  const double slope = std::atan2(up, out) * kDegrees;
  const double corner = std::acos(std::hypot(out, up) / 2 / 228.6) * kDegrees;
  const double upper_arm = slope + corner;
  const double forearm = slope - corner;
  // A block looks the same after half a turn, so the roll can be reduced to -90...90.
  double roll = base - place.angle + 90;
  roll -= 180 * std::round(roll / 180);
  robot.go({{'F', std::lround(base / 0.2269)},
            {'E', std::lround((90 - upper_arm) / 0.1135)},
            {'D', std::lround(forearm / 0.1135)},
            {'C', 0},
            {'B', std::lround(roll / 0.3125)}});
}

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);
  std::cout << std::fixed << std::setprecision(0);
  const Place block = find_largest(robot);

  robot.go({{'A', kOpen}});
  go_to(robot, block, kZ + kAbove);
  go_to(robot, block, kZ);
  robot.send("A+90\r");  // as in example 5
  robot.at['A'] += 90 - robot.wait('A');
  if (robot.at['A'] >= kShut) {
    std::cerr << "the jaws closed on nothing: is the block at x " << std::lround(block.x) << ", y "
              << std::lround(block.y)
              << " mm? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell)\n";
    go_to(robot, block, kZ + kAbove);  // back to the start position
    robot.go(kHome);
    return 1;
  }
  std::cout << "the jaws closed on " << std::setprecision(1) << 50.8 - 0.79375 * robot.at['A']
            << std::setprecision(0) << " mm\n";
  go_to(robot, block, kZ + kAbove);

  const Place target{392, 60, 90};  // a free place, the block's long side along y
  go_to(robot, target, kZ + kAbove);
  go_to(robot, target, kZ);
  robot.go({{'A', kOpen}});
  go_to(robot, target, kZ + kAbove);
  std::cout << "put down at x " << target.x << ", y " << target.y << " mm\n";

  find_largest(robot);
  robot.go(kHome);
  std::cout << "back at the start\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
