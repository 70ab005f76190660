// A goal of a task for a robot program, as a value: what must be true of the end of a run, or of
// the whole run. Independent of files and of the machine; docs/exec.md lists the kinds.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/units.hpp"

namespace xr3 {

/// A point, some of whose coordinates may be left open.
struct PartialPoint {
  std::optional<Micrometres> x{};
  std::optional<Micrometres> y{};
  std::optional<Micrometres> z{};
  bool operator==(const PartialPoint&) const = default;
};

/// A box with edges along the axes of the base frame, its surface included.
struct BoxUm {
  PointUm low;
  PointUm high;
  bool contains(const PointUm& p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
           p.z <= high.z;
  }
  bool operator==(const BoxUm&) const = default;
};

/// Goals by their kind. Points are in the base frame.
namespace goal {

/// A place for a block: its centroid is within `within_um` of a point, of an offset from another
/// block's centroid, or in a box; or only its yaw counts.
struct BlockPlace {
  std::string name;
  std::optional<PartialPoint> point{};
  std::optional<BoxUm> box{};
  std::string at{};  ///< name of the other block; empty if there is none
  PartialPoint offset{};
  Micrometres within_um = 5'000;
  std::optional<Microdegrees> yaw_udeg{};  ///< modulo half a turn, or a quarter for a square
  Microdegrees within_udeg = 5'000'000;
  bool may_be_held = false;
  bool operator==(const BlockPlace&) const = default;
};

/// A block rests on another one.
struct Stacked {
  std::string name;
  std::string on;
  bool operator==(const Stacked&) const = default;
};

enum class SortKey : std::uint8_t { kSize, kHeight, kColor };
enum class SortAxis : std::uint8_t { kX, kMinusX, kY, kMinusY };

/// Along an axis of the base frame, no block comes before one that is smaller, lower, or has a
/// lower color number.
struct Sorted {
  std::vector<std::string> names;  ///< empty for all blocks
  SortKey by = SortKey::kSize;
  SortAxis along = SortAxis::kX;
  bool operator==(const Sorted&) const = default;
};

/// The jaws hold this block.
struct Holding {
  std::optional<std::string> name{};  ///< nullopt for no block
  bool operator==(const Holding&) const = default;
};

/// A motor's variable or count.
struct JointValue {
  char label = 'A';
  std::optional<double> value{};  ///< degrees or mm
  std::optional<Counts> count{};
  double within = 0;  ///< in the unit of the value that is given
  bool operator==(const JointValue&) const = default;
};

/// The tool tip is within a distance of a point.
struct TipPlace {
  PartialPoint point;
  Micrometres within_um = 5'000;
  bool operator==(const TipPlace&) const = default;
};

/// The robot never stalled.
struct NoStall {};

/// Neither the controller reported a problem in the bytes that it received, nor the workcell a
/// warning.
struct NoWarnings {};

/// The controller's own soft home, which puts the arm there at once, was not used.
struct NoSoftHome {};

/// At no tick was one of the blocks further than this from where it was at the start.
struct Untouched {
  std::vector<std::string> names;
  Micrometres within_um = 1'000;
  bool operator==(const Untouched&) const = default;
};

/// At no tick was the tool tip in the box.
struct KeepOut {
  BoxUm box;
  bool operator==(const KeepOut&) const = default;
};

/// These events happened in this order, possibly with other events between them.
struct Order {
  std::vector<std::string> events;  ///< such as "grasped red"
  bool operator==(const Order&) const = default;
};

/// A limit of the simulated time from the start to the last count of a motor.
struct MaxSimTime {
  Tick ticks = 0;
  bool operator==(const MaxSimTime&) const = default;
};

/// A limit of the number of bytes that the program sent.
struct MaxBytes {
  std::uint64_t bytes = 0;
  bool operator==(const MaxBytes&) const = default;
};

/// A limit of the length of the tool tip's path.
struct MaxTipPath {
  Micrometres length_um = 0;
  bool operator==(const MaxTipPath&) const = default;
};

using Condition =
    std::variant<BlockPlace, Stacked, Sorted, Holding, JointValue, TipPlace, NoStall, NoWarnings,
                 NoSoftHome, Untouched, KeepOut, Order, MaxSimTime, MaxBytes, MaxTipPath>;

}  // namespace goal

struct Goal {
  int points = 1;
  std::string hint{};  ///< shown if the goal is missed; may be empty
  goal::Condition body;
};

/// The contents of a goals file.
struct GoalList {
  std::string notes;
  std::vector<Goal> goals;
  bool failed_program_counts = false;  ///< a program that fails gets points, too
};

/// Maximum number of goals in a file.
inline constexpr std::size_t kMaxGoals = 100;

}  // namespace xr3
