// A cell that was taken back to its past: it shows that state, and waits for the call `resume`.
#include <cassert>

#include "cell/cell.hpp"

namespace xr3 {

call::Refused Cell::in_the_past() {
  return {"in_the_past", "the robot was taken back to its past, and waits",
          "call resume to go on from here, which drops what came after, or seek another time"};
}

void Cell::handle(const Rewind& rewind, WallNs now) {
  assert(!device_);
  if (!is_in_past_) was_manual_ = clock_.mode() == ClockMode::kManual;
  carry_out(call::Pause{}, now);
  begin_epoch("seek", now, [&] {
    simulation_.restore(rewind.past->model, rewind.past->state);
    for (auto& [id, line] : lines_) line.reset();
  });
  is_in_past_ = true;
}

/// Bytes of the lines are read again.
void Cell::end_past() {
  if (!is_in_past_) return;
  is_in_past_ = false;
  for (const auto& [id, line] : lines_) woken_.push_back(id);
}

}  // namespace xr3
