#include "tests/seeds/reference.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3::seeds {

class Reference::Machine {
 public:
  Machine(ModelPtr model, LineKind kind)
      : cell("reference", std::move(model), SimClock::manual()),
        line(cell.apply(LineOpened{"test", kind}, 0).line) {}

  Cell cell;
  LineId line;
};

Reference::Reference(SharedModel model, Line line)
    : machine_(std::make_unique<Machine>(
          std::move(model), line == Line::kTcp ? LineKind::kTcp : LineKind::kMonitor)) {}

Reference::~Reference() = default;

std::string Reference::replies(std::string_view bytes) {
  auto& [cell, line] = *machine_;
  std::string all;
  for (;;) {
    bytes.remove_prefix(cell.apply(BytesIn{line, bytes}, 0).bytes_taken);
    const std::string_view outbox = cell.find_line(line)->outbox();
    all.append(outbox);
    cell.sent({line, outbox.size()});
    if (bytes.empty() || cell.find_line(line)->is_not_a_robot_program()) return all;
  }
}

std::string Reference::last_replies() {
  auto& [cell, line] = *machine_;
  cell.apply(InputEnded{line}, 0);
  return std::string(cell.find_line(line)->outbox());
}

std::string Reference::hexadecimal_replies(std::string_view bytes) {
  return hexadecimal(replies(bytes));
}

void Reference::step(std::int64_t ticks) { machine_->cell.apply(call::Step{ticks}, 0); }

std::int64_t Reference::tick() const { return machine_->cell.state().tick; }

std::string Reference::joints() const {
  const Cell& cell = machine_->cell;
  return state_json(cell.model(), cell.snapshot())["joints"].dump();
}

}  // namespace xr3::seeds
