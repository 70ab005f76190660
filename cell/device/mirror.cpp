#include "cell/device/mirror.hpp"

#include <cassert>
#include <utility>

namespace xr3 {

bool Mirror::differs(char label, const JointReading& reading, Tick now) {
  assert(label >= 'A' && label <= 'H');
  MirroredJoint& joint = joints_[static_cast<std::size_t>(label - 'A')];
  if (joint.last != reading) {
    joint.last = reading;
    joint.since = now;
  }
  if (reading.device == reading.simulation) joint.is_reported = false;
  const bool is_still = now - joint.since >= kStill;
  if (reading.device == reading.simulation || !is_still) return false;
  return !std::exchange(joint.is_reported, true);
}

}  // namespace xr3
