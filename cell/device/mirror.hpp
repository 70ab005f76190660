// Compares the simulation with the physical controller while both carry out the same commands
// (`--mirror`). Only error counters that stand still are compared: two machines never move at
// exactly the same time.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "core/state.hpp"

namespace xr3 {

class Mirror {
 public:
  /// Both counters must have been unchanged for this time, as far as inquiries tell.
  static constexpr Tick kStill = 500;

  /// What `a?` tells of a joint, in counts.
  struct JointReading {
    int device = 0;
    int simulation = 0;
    bool operator==(const JointReading&) const = default;
  };

  /// Notes a reading of the joint with this label, 'A' to 'H'. Returns whether it is a difference
  /// that was not reported yet.
  bool differs(char label, const JointReading& reading, Tick now);

  /// The simulation has stalled or reached a limit: it no longer shows where the arm is. Returns
  /// whether that is news.
  bool lose() { return !std::exchange(is_lost_, true); }
  /// The simulation stands where the arm stands.
  void align() { *this = {}; }

  bool operator==(const Mirror&) const = default;

 private:
  struct MirroredJoint {
    std::optional<JointReading> last;
    Tick since = 0;  ///< last is unchanged
    bool is_reported = false;
    bool operator==(const MirroredJoint&) const = default;
  };

  std::array<MirroredJoint, 8> joints_;
  bool is_lost_ = false;
};

}  // namespace xr3
