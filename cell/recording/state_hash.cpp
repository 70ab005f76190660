#include "cell/recording/state_hash.hpp"

#include <nlohmann/json.hpp>

#include "cell/digest.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/line/state_writer.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {

// A new member of Rewindable does not compile here until somebody has decided whether it belongs to
// the digest. The others do not, since what they decide is in an input, or shows in the machine.
std::string StateHasher::hash(const Cell& cell) {
  const Rewindable& state = cell.value();
  const auto& [machine, clock, epoch, model_rev, byte_clock, transcript, agenda, lines, last_line,
               snapshots, due_bytes, in_past, frozen] = state;
  if (model_ != cell.model_ptr()) {
    model_ = cell.model_ptr();
    model_hash_ = sha256(robot_hash(*model_) + workcell_to_json(model_->workcell()).dump());
  }
  StateWriter out;
  out.add(kStateFormat, model_hash_, epoch, model_rev, cell.clock_remainder(), clock.mode(),
          clock.rate().millionths, saved_state_to_json(machine.state()).dump(), last_line,
          lines.size());
  for (const auto& [id, line] : lines) out.add(id, line);
  if (cell.device() != nullptr) out.add(*cell.device());
  return sha256(out.bytes());
}

}  // namespace xr3
