#include <memory>

#include "cell/calls/calls.hpp"
#include "cell/digest.hpp"
#include "cell/epoch.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {
namespace {

SavedCellPtr saved_cell(const Model& model, const State& state) {
  return std::make_shared<const SavedCell>(SavedCell{robot_hash(model), model.workcell(), state});
}

}  // namespace

call::Outcome carry_out(CellState& cell, const call::SaveSnapshot& save, WallNs, CellOutput&) {
  const bool is_new = !save.name.empty() && !cell.snapshots.contains(save.name);
  if (is_new && cell.snapshots.size() >= kMaxSnapshots) {
    return call::Refused{"limit", "there are 16 snapshots already",
                         "save under a name that is in use, or inline"};
  }
  const SavedCellPtr saved = saved_cell(cell.model(), cell.state());
  if (save.name.empty() && !monitor::fits_a_request(*saved)) {
    return call::Refused{"limit", "the snapshot exceeds the maximum size of a request, 256 KiB",
                         "save under a name"};
  }
  if (!save.name.empty()) {
    cell.snapshots[save.name] = std::make_shared<const MachineSnapshot>(
        MachineSnapshot{cell.machine.model_ptr(), cell.state()});
  }
  return call::Done{{}, {}, saved};
}

call::Outcome carry_out(CellState& cell, const call::LoadSnapshot& load, WallNs now,
                        CellOutput& out) {
  if (!load.saved) {
    const auto found = cell.snapshots.find(load.name);
    if (found == cell.snapshots.end())
      return call::Refused{"no_such_snapshot", "there is no snapshot " + load.name,
                           "snapshot_save makes one"};
    const MachineSnapshotPtr snapshot = found->second;
    begin_epoch(
        cell, "snapshot_load", now, [&] { cell.machine.restore(snapshot->model, snapshot->state); },
        out);
    return call::Done{{}, {}, saved_cell(*snapshot->model, snapshot->state)};
  }
  const SavedCell& saved = *load.saved;
  if (saved.robot_hash != robot_hash(cell.model())) {
    return call::Refused{"model_mismatch", "the snapshot is of another robot or profile",
                         "load it into a server with the same --robot and --compat"};
  }
  begin_epoch(
      cell, "snapshot_load", now,
      [&] { cell.machine.restore(cell.model_with(saved.workcell), saved.state); }, out);
  return call::Done{{}, {}, load.saved};
}

}  // namespace xr3
