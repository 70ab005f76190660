// The contents of a robot file: joints with their Denavit-Hartenberg rows and drives, the tool, the
// outline for drawing, couplings, protected region and net roll (paper, Section III-A and
// Table II). Plain values in millimetres and degrees; the loader has already converted inches.
// Independent of files, JSON and the state.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"

namespace xr3 {

/// Maximum number of joints, one for each letter B...H; the tool, A, is not a joint. A carousel
/// needs one of these letters.
inline constexpr int kMaxJoints = 7;
/// Maximum number of motors: one per joint, one for the tool, and one for the carousel.
inline constexpr int kMaxMotors = kMaxJoints + 1;

/// Positions of the joints, from the base, then of the tool and of the carousel, in counts from the
/// soft home.
using Positions = std::array<Counts, kMaxMotors>;

/// Which Denavit-Hartenberg parameter the motor changes (the paper's jvar 1 and 2).
enum class JointVariable : std::uint8_t { kTheta, kD };

/// The motion of the fingers: on a slide (the variable is a distance in mm) or on hinges (an angle
/// in degrees).
enum class ToolKind : std::uint8_t { kParallel, kAngular };

/// A microswitch, driven by the count of its own motor.
struct Microswitch {
  Counts position = 0;    ///< count at which it closes; the sign is the side on which it is closed
  std::uint8_t mask = 0;  ///< bit in the reply to I or J; 0 if in neither
  std::optional<Counts> width;  ///< if set, closed only while 2*|count - position| <= width
  /// If set, the switch closes again after this number of counts, as that of a joint without stops
  /// does once a turn. Only the mark3 profile uses it.
  std::optional<Counts> period;
  bool operator==(const Microswitch&) const = default;
};

/// A DC motor with an incremental encoder. Every joint has one, and so does the tool.
struct Drive {
  char label = 'A';            ///< A for the tool; B...H, each at most once, for a joint
  double precision = 0;        ///< degrees or mm per count, above 0
  double min = 0;              ///< lower limit of the variable, degrees or mm
  double max = 0;              ///< upper limit of the variable, degrees or mm
  double home = 0;             ///< the variable at the soft home, degrees or mm
  int speed_counts_per_s = 0;  ///< 1...255
  int direction = 1;           ///< +1: positive counts increase the variable; -1: decrease it
  Microswitch microswitch;
  bool operator==(const Drive&) const = default;
};

/// One row of the Denavit-Hartenberg table at the soft home: T(k-1,k) of the paper's equation (2).
struct DhRow {
  double theta_deg = 0;
  double d_mm = 0;
  double a_mm = 0;
  double alpha_deg = 0;
  bool operator==(const DhRow&) const = default;
};

struct Joint {
  std::string name;
  JointVariable variable = JointVariable::kTheta;
  DhRow dh;
  Drive drive;
  bool is_revolute() const { return variable == JointVariable::kTheta; }
  bool operator==(const Joint&) const = default;
};

/// A corner of an outline: move the pen there, or draw a line to it.
struct OutlinePoint {
  bool draw = false;
  PointMm p_mm;
  bool operator==(const OutlinePoint&) const = default;
};

/// The outline of one link in the link's own frame. Link 0 is the base, link n the tool's body.
struct Outline {
  int color = 0;  ///< palette index 0...15
  std::vector<OutlinePoint> points;
  bool operator==(const Outline&) const = default;
};

/// A moving part of the tool, in frame n with the jaws closed. The tool's motor shifts it by
/// side * opening / 2 along y (parallel) or turns it by side * angle / 2 about x through its pivot.
struct ToolPart {
  int side = 1;   ///< +1 or -1
  int color = 0;  ///< palette index 0...15
  PointMm pivot_mm;
  std::vector<OutlinePoint> points;
  bool operator==(const ToolPart&) const = default;
};

struct Tool {
  ToolKind kind = ToolKind::kParallel;
  Drive drive;
  double finger_length_mm = 0;  ///< angular jaws only
  std::vector<ToolPart> parts;
  bool operator==(const Tool&) const = default;
};

/// A round table beside the arm that a motor turns about a vertical axis; not a joint of the arm.
/// The variable of its motor is the table's angle, 0 at the soft home, counterclockwise from above.
struct Carousel {
  std::string name;
  Drive drive;
  double x_mm = 0;  ///< x of the axis, in the base frame
  double y_mm = 0;
  double radius_mm = 0;
  double height_mm = 0;  ///< height of the top above the base plane
  int color = 0;         ///< palette index 0...15
  bool operator==(const Carousel&) const = default;
};

/// Motor `joint` also moves joint `coupled`. In joint variables: in the same direction (sign +1) or
/// in the opposite one (-1).
struct Coupling {
  int joint = 0;    ///< index from 0 at the base
  int coupled = 0;  ///< index from 0 at the base
  int sign = 1;
  bool operator==(const Coupling&) const = default;
};

/// A cylinder about the base axis that the tool tip may not enter: r < radius and z < height.
struct ProtectedRegion {
  double radius_mm = 0;
  double height_mm = 0;
  bool operator==(const ProtectedRegion&) const = default;
};

/// One term of the net roll: a joint variable, added or subtracted.
struct RollTerm {
  int joint = 0;  ///< index from 0 at the base
  int sign = 1;
  bool operator==(const RollTerm&) const = default;
};

struct Robot {
  std::string name;
  std::string notes;
  std::optional<DhRow> mount;  ///< from the base frame to frame 0, without a joint
  std::vector<Joint> joints;   ///< from the base; 1...kMaxJoints elements
  Tool tool;
  std::optional<Carousel> carousel;
  std::vector<Outline> links;  ///< joints.size() + 1 elements, or none
  std::vector<Coupling> couplings;
  ProtectedRegion protected_region;
  std::vector<RollTerm> net_roll;
  double net_roll_offset_deg = 0;
  bool operator==(const Robot&) const = default;
};

}  // namespace xr3
