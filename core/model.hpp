// The immutable Model of a cell: robot, workcell and profile, and all integers and tables computed
// from them at load time. Floating point therefore never decides a count at run time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot.hpp"
#include "core/trig.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// The emulated controller: the paper's simulator, or the hardware (Mark III) that surviving
/// programs were written for.
enum class Profile : std::uint8_t { kPaper, kMark3 };

/// Counts beyond its position at which a switch without a width in its file opens again, in the
/// mark3 profile.
inline constexpr Counts kMark3SwitchRange = 60;

/// A range of counts. Both ends are included.
struct CountRange {
  Counts low;
  Counts high;
  bool operator==(const CountRange&) const = default;
};

/// Integers of one motor and of the joint (or tool, or carousel) it drives.
struct MotorModel {
  Drive drive;
  Counts low = 0;           ///< minimum joint position within the limits, counts from the soft home
  Counts high = 0;          ///< maximum joint position within the limits
  CountRange closed{0, 0};  ///< the motor's counts at which its microswitch is closed
  Counts period = 0;        ///< counts after which the range repeats; 0 if it does not

  /// The number of counts by which a position is past a limit; 0 within both.
  Counts excess(Counts position) const { return std::max({low - position, position - high, 0}); }
  bool operator==(const MotorModel&) const = default;
};

/// A joint that a motor moves, and its counts per count of the motor.
struct CoupledJoint {
  std::uint8_t joint = 0;
  std::int8_t gain = 0;
  bool operator==(const CoupledJoint&) const = default;
};

/// The carousel in the units of decisions.
struct CarouselModel {
  Micrometres x_um = 0;  ///< x of the axis
  Micrometres y_um = 0;
  Micrometres radius_um = 0;
  Micrometres top_um = 0;  ///< z of the top
  double step_deg = 0;     ///< the turn per count, counterclockwise from above
};

/// The angles of the row between the base frame and frame 0.
struct MountAngles {
  SinCos theta;
  SinCos twist;
};

class Model {
 public:
  /// Computes the integers and tables. Precondition: `robot` satisfies the rules of robot files
  /// (1...kMaxJoints joints).
  Model(Robot robot, Workcell workcell, Profile profile);

  const Robot& robot() const { return robot_; }
  const Workcell& workcell() const { return workcell_; }
  Profile profile() const { return profile_; }

  int joint_count() const { return joint_count_; }
  /// The number of motors: one per joint, from the base, then the tool's, then the carousel's.
  int motor_count() const { return motor_count_; }
  int tool_index() const { return joint_count_; }
  /// Index of the carousel's motor; -1 without a carousel.
  int carousel_index() const { return carousel_ ? joint_count_ + 1 : -1; }

  const MotorModel& motor(int index) const { return motors_[static_cast<std::size_t>(index)]; }
  /// Index of the motor with this label, or -1.
  int index_of(char label) const {
    return label >= 'A' && label <= kLastLabel ? indices_[static_cast<std::size_t>(label - 'A')]
                                               : -1;
  }
  /// The labels of all motors, in the order of the alphabet.
  std::string labels() const;
  /// The name of a joint or of the carousel, or `tool`.
  std::string name(int index) const;
  /// Whether the variable of a motor is a length in mm; if not, an angle in degrees.
  bool is_length(int index) const;

  /// The joints that motor `index` moves: its own first, then those coupled to it.
  const std::vector<CoupledJoint>& driven_by(int index) const {
    return driven_[static_cast<std::size_t>(index)];
  }
  /// Counts of joint `joint` per count of motor `motor`; 1 on the diagonal.
  int gain(int joint, int motor) const {
    return gain_[static_cast<std::size_t>(joint)][static_cast<std::size_t>(motor)];
  }

  /// The variable of a joint, the tool or the carousel at a position, in degrees or mm.
  double variable(int index, Counts position) const;
  /// Sine and cosine of joint `joint`'s theta at a position; constant for a prismatic joint.
  SinCos theta(int joint, Counts position) const;
  /// Distance along joint `joint`'s axis (Denavit-Hartenberg d) at a position; constant for a
  /// revolute joint.
  double link_offset_mm(int joint, Counts position) const;
  /// Denavit-Hartenberg a of joint `joint`.
  double link_length_mm(int joint) const {
    return robot_.joints[static_cast<std::size_t>(joint)].dh.a_mm;
  }
  /// Sine and cosine of the link twist of joint `joint`.
  const SinCos& twist(int joint) const { return twists_[static_cast<std::size_t>(joint)]; }
  /// Sines and cosines of theta and alpha of the robot's mount; empty if it has none.
  const std::optional<MountAngles>& mount_angles() const { return mount_angles_; }
  /// The number of prismatic joints before the first revolute one: they move the whole arm.
  int slide_count() const { return slide_count_; }

  const std::optional<CarouselModel>& carousel() const { return carousel_; }

  Micrometres region_radius_um() const { return region_radius_um_; }
  Micrometres region_height_um() const { return region_height_um_; }

 private:
  static constexpr char kLastLabel = 'H';

  void find_labels();
  void find_gains();
  void fill_tables();

  Robot robot_;
  Workcell workcell_;
  Profile profile_;
  std::vector<MotorModel> motors_;
  int joint_count_;  ///< a member, like motor_count_, because loops of every tick read it
  int motor_count_;
  std::array<std::int8_t, kLastLabel - 'A' + 1> indices_{};  ///< index of the motor by label, or -1
  std::array<std::vector<CoupledJoint>, kMaxMotors> driven_;
  std::array<std::array<std::int8_t, kMaxMotors>, kMaxMotors> gain_{};
  std::vector<SinCosTable> thetas_;
  std::vector<SinCos> twists_;
  std::optional<MountAngles> mount_angles_;
  int slide_count_ = 0;
  std::optional<CarouselModel> carousel_;
  Micrometres region_radius_um_ = 0;
  Micrometres region_height_um_ = 0;
};

/// Position limits in whole counts, rounded inwards with a tolerance of 1e-6 counts.
CountRange count_limits(const Drive& drive);

/// The counts of its motor at which a switch is closed. With a width: near its position, as on the
/// hardware. Without one: at its position and beyond it, seen from the soft home; in the paper
/// profile without an end, so that the switch stays closed while the joint moves on, and in mark3
/// for kMark3SwitchRange counts.
CountRange closed_range(const Microswitch& microswitch, Profile profile);

using ModelPtr = std::shared_ptr<const Model>;

}  // namespace xr3
