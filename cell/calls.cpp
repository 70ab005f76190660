// The effect of each call on a cell.
#include <algorithm>
#include <utility>

#include "cell/cell.hpp"
#include "cell/digest.hpp"
#include "core/camera.hpp"
#include "core/carousel.hpp"
#include "core/placement.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxNamed = 16;  ///< names in a hint

call::Refused clock_running(std::string_view call) {
  return {"clock_running", std::string(call) + " needs the manual clock; the clock is real",
          "call pause first, or start with --clock manual"};
}

call::Refused has_device() {
  return {"has_device", "time cannot be changed while a device is connected",
          "start the server without --serial to control time"};
}

call::Refused no_such_block(const State& state, const std::string& name) {
  const std::size_t count = state.blocks.size();
  std::string names;
  for (std::size_t i = 0; i < std::min(count, kMaxNamed); ++i)
    names += (names.empty() ? "" : ", ") + state.blocks[i].name;
  if (count > kMaxNamed) names += " and " + std::to_string(count - kMaxNamed) + " more";
  return {"no_such_block", "there is no block " + name,
          names.empty() ? "the workcell has no blocks" : "the blocks are " + names};
}

/// Refuses a block whose addition would make the camera's images too costly.
std::optional<call::Refused> refuse_rows(const Model& model, const State& state,
                                         std::int64_t more_rows) {
  const std::int64_t rows = camera_rows(model.workcell(), state.blocks) + more_rows;
  if (more_rows <= 0 || rows <= kMaxCameraRows) return std::nullopt;
  return call::Refused{"limit",
                       "the blocks would take " + std::to_string(rows) +
                           " rows of the camera's image, each row counted for each block; " +
                           std::to_string(kMaxCameraRows) + " are allowed",
                       "use smaller blocks, or call block_remove first"};
}

call::Refused block_held(const std::string& name) {
  return {"block_held", "the jaws hold block " + name, "open the jaws first"};
}

/// Whether the blocks are equal except for their positions.
bool are_same_things(const SharedVector<Block>& a, const SharedVector<Block>& b) {
  if (a.is_shared_with(b)) return true;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Block& x, const Block& y) {
    return x.name == y.name && x.size_um == y.size_um && x.color == y.color;
  });
}

SavedCellPtr saved_cell(const Model& model, const State& state) {
  return std::make_shared<const SavedCell>(SavedCell{robot_hash(model), model.workcell(), state});
}

}  // namespace

// --- Time.

call::Outcome Cell::carry_out(const call::Pause&, WallNs now) {
  if (device_) return has_device();
  const bool is_new = clock_.mode() != ClockMode::kManual;
  clock_.pause(now);
  if (is_new) emit(std::nullopt, ClockNote{"pause", clock_.mode(), clock_.rate()});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Resume&, WallNs now) {
  const bool was_in_past = is_in_past_;
  end_past();
  if (was_in_past && was_manual_) return call::Done{};
  const bool is_new = clock_.mode() != clock_.running_mode();
  clock_.resume(now);
  if (is_new) emit(std::nullopt, ClockNote{"resume", clock_.mode(), clock_.rate()});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::SetRate& rate, WallNs now) {
  if (device_) return has_device();
  if (clock_.running_mode() == ClockMode::kBytes) {
    return call::Refused{"no_rate",
                         "the byte clock has no rate: time moves with the bytes of the lines",
                         "start with --clock real to set a rate"};
  }
  clock_.set_rate(rate.rate, now);
  emit(std::nullopt, ClockNote{"rate", clock_.mode(), clock_.rate()});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Step& step, WallNs now) {
  if (clock_.mode() == ClockMode::kReal) return clock_running("step");
  const Tick start = state().tick;
  advance_to(start + step.ticks);
  after_manual_advance(start, now);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::RunUntil& run, WallNs now) {
  if (clock_.mode() == ClockMode::kReal) return clock_running("run_until");
  const Tick start = state().tick;
  const Tick limit = start + run.max_ticks;
  if (run.tick) {
    advance_to(std::min(limit, *run.tick));
  } else {
    run_to_rest(limit);
  }
  after_manual_advance(start, now);
  const bool reached = run.tick ? state().tick >= *run.tick : is_at_rest();
  return call::Done{reached, state().tick - start, nullptr};
}

/// Synchronizes the clock and the counters after the manual clock advanced from `start`.
void Cell::after_manual_advance(Tick start, WallNs now) {
  clock_.set_tick(state().tick, now);
  counters_.ticks += static_cast<std::uint64_t>(state().tick - start);
}

call::Outcome Cell::carry_out(const call::Reset&, WallNs now) {
  begin_epoch("reset", now, [this] {
    simulation_.reset();
    simulation_.install_faults(initial_faults_);
    for (auto& [id, line] : lines_) line.reset();
  });
  return call::Done{};
}

// The note has the first tick of the new epoch and contains the last tick of the old one.
void Cell::begin_epoch(std::string_view call, WallNs now, const std::function<void()>& change) {
  for (const auto& [id, line] : lines_) emit_all(id, warnings_.forget(id));
  const EpochNote note{call, epoch_, state().tick};
  const ModelPtr old_model = simulation_.model_ptr();
  const SharedVector<Block> old_blocks = state().blocks;
  change();
  if (device_ && state().enabled && device_->is_engaged()) device_->engage(false);
  ++epoch_;
  last_input_tick_.reset();
  clock_.set_tick(state().tick, now);
  restart_bytes();
  restart_lines();
  for (auto& [id, line] : lines_) line.begin_epoch(state().tick);
  if (device_) device_->begin_epoch(state().tick);
  emit(std::nullopt, note);
  const bool is_same =
      old_model->workcell() == model().workcell() && are_same_things(old_blocks, state().blocks);
  if (!is_same) changed_model(call, model().workcell().name);
}

// --- The machine.

call::Outcome Cell::carry_out(const call::Home&, WallNs) {
  simulation_.execute(SoftHome{});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Key& key, WallNs) {
  const bool was_enabled = state().enabled;
  simulation_.execute(key.command);
  if (device_ && state().enabled != was_enabled) device_->engage(was_enabled);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::SetInput& input, WallNs) {
  simulation_.set_input(input.input, input.value);
  return call::Done{};
}

// --- The workcell.

void Cell::changed_model(std::string_view call, const std::string& name) {
  emit(std::nullopt, ModelNote{call, name, ++model_rev_});
}

// The call added or moved this block.
void Cell::placed_block(std::string_view call, std::size_t block) {
  find_riders(model(), simulation_.edit());
  changed_model(call, state().blocks[block].name);
  Events warnings;
  warn_of_overlap(model(), state(), block, warnings);
  emit_machine_events(std::nullopt, std::move(warnings));
}

ModelPtr Cell::model_with(const Workcell& workcell) const {
  return std::make_shared<const Model>(model().robot(), workcell, model().profile());
}

call::Outcome Cell::carry_out(const call::AddBlock& add, WallNs) {
  const std::string& name = add.block.name;
  if (find_block(state(), name)) {
    return call::Refused{"name_taken", "there is a block " + name + " already",
                         "choose another name, or call block_move"};
  }
  const std::size_t max_blocks = is_replayed_ ? kMaxBlocks : kMaxFileBlocks;
  if (state().blocks.size() >= max_blocks) {
    return call::Refused{"limit",
                         "a workcell has at most " + std::to_string(max_blocks) + " blocks",
                         "call block_remove first"};
  }
  if (auto refused = refuse_rows(model(), state(), camera_rows(model().workcell(), {add.block})))
    return *std::move(refused);
  simulation_.edit().blocks.edit().push_back(add.block);
  placed_block("block_add", state().blocks.size() - 1);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::MoveBlock& move, WallNs) {
  const auto index = find_block(state(), move.name);
  if (!index) return no_such_block(state(), move.name);
  if (is_held(state(), *index)) return block_held(move.name);
  Block moved = state().blocks[*index];
  moved.centroid_um = move.centroid_um.value_or(moved.centroid_um);
  moved.yaw_udeg = move.yaw_udeg.value_or(moved.yaw_udeg);
  const Workcell& workcell = model().workcell();
  const std::int64_t more_rows =
      camera_rows(workcell, {moved}) - camera_rows(workcell, {state().blocks[*index]});
  if (auto refused = refuse_rows(model(), state(), more_rows)) return *std::move(refused);
  simulation_.edit().blocks.edit()[*index] = std::move(moved);
  placed_block("block_move", *index);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::RemoveBlock& remove, WallNs) {
  const auto index = find_block(state(), remove.name);
  if (!index) return no_such_block(state(), remove.name);
  if (is_held(state(), *index)) return block_held(remove.name);
  remove_block(model(), simulation_.edit(), *index);
  changed_model("block_remove", remove.name);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::ReplaceWorkcell& replace, WallNs) {
  simulation_.replace_workcell(model_with(replace.workcell));
  changed_model("workcell", replace.workcell.name);
  return call::Done{};
}

// --- Snapshots.

call::Outcome Cell::carry_out(const call::SaveSnapshot& save, WallNs) {
  const bool is_new = !save.name.empty() && !snapshots_.contains(save.name);
  if (is_new && snapshots_.size() >= kMaxSnapshots) {
    return call::Refused{"limit", "there are 16 snapshots already",
                         "save under a name that is in use, or inline"};
  }
  const SavedCellPtr saved = saved_cell(model(), state());
  if (save.name.empty() && !monitor::fits_a_request(*saved)) {
    return call::Refused{"limit", "the snapshot exceeds the maximum size of a request, 256 KiB",
                         "save under a name"};
  }
  if (!save.name.empty()) {
    snapshots_[save.name] =
        std::make_shared<const MachineSnapshot>(MachineSnapshot{model_ptr(), state()});
  }
  return call::Done{{}, {}, saved};
}

call::Outcome Cell::carry_out(const call::LoadSnapshot& load, WallNs now) {
  if (!load.saved) {
    const auto found = snapshots_.find(load.name);
    if (found == snapshots_.end())
      return call::Refused{"no_such_snapshot", "there is no snapshot " + load.name,
                           "snapshot_save makes one"};
    const MachineSnapshotPtr snapshot = found->second;
    begin_epoch("snapshot_load", now,
                [&] { simulation_.restore(snapshot->model, snapshot->state); });
    return call::Done{{}, {}, saved_cell(*snapshot->model, snapshot->state)};
  }
  const SavedCell& saved = *load.saved;
  if (saved.robot_hash != robot_hash(model())) {
    return call::Refused{"model_mismatch", "the snapshot is of another robot or profile",
                         "load it into a server with the same --robot and --compat"};
  }
  begin_epoch("snapshot_load", now,
              [&] { simulation_.restore(model_with(saved.workcell), saved.state); });
  return call::Done{{}, {}, load.saved};
}

}  // namespace xr3
