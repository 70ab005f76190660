#include "core/faults/fault.hpp"

#include <array>
#include <limits>

namespace xr3 {
namespace {

using enum FaultTarget;
using enum FaultManner;

constexpr FaultTraits kBytes{kLine, kEffects, true, true, true};
constexpr FaultTraits kStream{kLine, kEffects, true, false, false};
constexpr FaultTraits kJointLasts{kJoint, kLasting, false, false, false};
constexpr FaultTraits kCounts{kJoint, kEffects, false, true, true};
constexpr FaultTraits kCameraLasts{kCamera, kLasting, false, false, false};

constexpr std::array<FaultTraits, kFaultKinds> kTraits = {{
    kBytes,                                    // byte_dropped
    kBytes,                                    // byte_flipped
    kBytes,                                    // byte_doubled
    {kLine, kEffects, false, true, true},      // stray_byte
    kBytes,                                    // parity_error
    kStream,                                   // wrong_baud
    kStream,                                   // wrong_parity
    kBytes,                                    // reply_lost
    kBytes,                                    // reply_delayed
    {kLine, kLasting, false, false, false},    // reply_batched
    {kLine, kLasting, false, false, false},    // xoff_stall
    kBytes,                                    // line_disconnected
    {kController, kOnce, false, false, true},  // power_cycle
    kJointLasts,                               // motor_stuck
    kJointLasts,                               // motor_slow
    kCounts,                                   // encoder_slip
    {kJaws, kEffects, false, true, true},      // grip_slip
    kJointLasts,                               // switch_stuck_open
    kJointLasts,                               // switch_stuck_closed
    kJointLasts,                               // switch_bouncing
    {kCamera, kLasting, false, true, false},   // camera_noise
    kCameraLasts,                              // camera_dead_row
    kCameraLasts,                              // camera_offset
}};

}  // namespace

const FaultTraits& traits_of(FaultKind kind) { return kTraits[static_cast<std::size_t>(kind)]; }

std::uint64_t Fault::limit() const {
  if (count) return *count;
  const bool is_once = traits_of(kind).is_once_at_first && (at_tick || after_bytes) && !ticks;
  return is_once ? 1 : std::numeric_limits<std::uint64_t>::max();
}

bool lasts(const Fault& fault) { return traits_of(fault.kind).manner == FaultManner::kLasting; }

bool is_timed(const Fault& fault) {
  return traits_of(fault.kind).manner == FaultManner::kOnce ||
         (fault.kind == FaultKind::kLineDisconnected && fault.at_tick);
}

}  // namespace xr3
