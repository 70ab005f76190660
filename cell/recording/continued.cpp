#include "cell/recording/continued.hpp"

#include <cassert>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/digest.hpp"
#include "cell/recording/replayer.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3 {
namespace {

using recording::ContinuedState;

MachineSnapshotPtr machine_of(const Cell& cell, const SavedCell& saved) {
  const bool is_same = saved.workcell == cell.model().workcell();
  return std::make_shared<const MachineSnapshot>(MachineSnapshot{
      is_same ? cell.model_ptr() : cell.value().model_with(saved.workcell), saved.state});
}

}  // namespace

std::string origin_of(const recording::Header& header) {
  if (header.start) return header.start->origin;
  const Json faults = header.faults ? faults_to_json(*header.faults) : Json();
  return sha256(workcell_to_json(header.model->workcell()).dump() + faults.dump());
}

ContinuedState continued_state(const Cell& cell, std::string origin) {
  assert(cell.lines().empty() && cell.device() == nullptr);
  const Rewindable& value = cell.value();
  const std::string hash = robot_hash(cell.model());
  ContinuedState start;
  start.origin = std::move(origin);
  start.epoch = value.epoch;
  start.us = static_cast<int>(cell.clock_remainder());
  start.model_rev = value.model_rev;
  start.last_line = value.last_line;
  if (value.in_past) start.past_was_manual = value.in_past->was_manual;
  if (value.frozen) start.freeze_was_manual = value.frozen->was_manual;
  start.saved = {hash, cell.model().workcell(), cell.state()};
  for (const auto& [name, each] : value.snapshots)
    start.snapshots.push_back({name, {hash, each->model->workcell(), each->state}});
  return start;
}

void begin_at_start(Cell& cell, const recording::Header& header, WallNs now) {
  assert(header.start && !header.device);
  const ContinuedState& start = *header.start;
  const MachineSnapshotPtr machine = machine_of(cell, start.saved);
  Rewindable begin{Simulation(machine->model), replay_clock(header)};
  begin.machine.restore(machine->state);
  begin.clock.set_tick(begin.machine.tick(), now);
  begin.epoch = start.epoch;
  begin.model_rev = start.model_rev;
  begin.last_line = start.last_line;
  if (header.byte_clock) begin.byte_clock.emplace(*header.byte_clock, header.line_speed);
  if (begin.byte_clock) begin.byte_clock->set_remainder(start.us);
  if (start.past_was_manual) begin.in_past = InPast{*start.past_was_manual};
  if (start.freeze_was_manual) begin.frozen = Frozen{*start.freeze_was_manual};
  for (const auto& [name, saved] : start.snapshots)
    begin.snapshots.emplace(name, machine_of(cell, saved));
  cell.continue_from(std::move(begin), header.faults.value_or(FaultPlan{}),
                     header.byte_clock ? std::nullopt : header.line_speed, start.origin);
}

}  // namespace xr3
