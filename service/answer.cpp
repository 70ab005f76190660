#include "service/answer.hpp"

#include <nlohmann/json.hpp>

namespace xr3::service {

Json value_now(const Cell& cell) { return {{"epoch", cell.epoch()}, {"tick", cell.state().tick}}; }

monitor::Message refused(const monitor::RequestId& id, const call::Refused& why) {
  return monitor::result({id, why.code, why.message, why.hint, {}});
}

call::Refused no_such_line(LineId line) {
  return {"no_such_line", "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened"};
}

}  // namespace xr3::service
