#include "cell/recording/state_hash.hpp"

#include <nlohmann/json.hpp>

#include "cell/digest.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/line/state_writer.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {

std::string StateHasher::hash(const Cell& cell) {
  if (model_ != cell.model_ptr()) {
    model_ = cell.model_ptr();
    model_hash_ = sha256(robot_hash(*model_) + workcell_to_json(model_->workcell()).dump());
  }
  StateWriter out;
  out.add(kStateFormat, model_hash_, cell.epoch(), cell.model_rev(), cell.clock_remainder(),
          cell.clock().mode(), cell.clock().rate().millionths,
          saved_state_to_json(cell.state()).dump(), cell.last_line(), cell.lines().size());
  for (const auto& [id, line] : cell.lines()) out.add(id, line);
  if (cell.device() != nullptr) out.add(*cell.device());
  return sha256(out.bytes());
}

}  // namespace xr3
