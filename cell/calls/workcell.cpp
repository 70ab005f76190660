#include "protocol/files/workcell.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cell/calls/calls.hpp"
#include "cell/epoch.hpp"
#include "cell/events.hpp"
#include "core/camera.hpp"
#include "core/carousel.hpp"
#include "core/placement.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxNamed = 16;  ///< names in a hint

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

// The call added or moved this block.
void placed_block(CellState& cell, std::string_view call, std::size_t block, CellOutput& out) {
  find_riders(cell.model(), cell.machine.edit());
  changed_model(cell, call, cell.state().blocks[block].name, out);
  Events warnings;
  warn_of_overlap(cell.model(), cell.state(), block, warnings);
  emit_machine_events(cell, std::move(warnings), out);
}

}  // namespace

call::Outcome carry_out(CellState& cell, const call::AddBlock& add, WallNs, CellOutput& out) {
  const std::string& name = add.block.name;
  if (find_block(cell.state(), name)) {
    return call::Refused{"name_taken", "there is a block " + name + " already",
                         "choose another name, or call block_move"};
  }
  const std::size_t max_blocks = cell.is_replayed ? kMaxBlocks : kMaxFileBlocks;
  if (cell.state().blocks.size() >= max_blocks) {
    return call::Refused{"limit",
                         "a workcell has at most " + std::to_string(max_blocks) + " blocks",
                         "call block_remove first"};
  }
  if (auto refused = refuse_rows(cell.model(), cell.state(),
                                 camera_rows(cell.model().workcell(), {add.block})))
    return *std::move(refused);
  cell.machine.edit().blocks.edit().push_back(add.block);
  placed_block(cell, "block_add", cell.state().blocks.size() - 1, out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::MoveBlock& move, WallNs, CellOutput& out) {
  const auto index = find_block(cell.state(), move.name);
  if (!index) return no_such_block(cell.state(), move.name);
  if (is_held(cell.state(), *index)) return block_held(move.name);
  Block moved = cell.state().blocks[*index];
  moved.centroid_um = move.centroid_um.value_or(moved.centroid_um);
  moved.yaw_udeg = move.yaw_udeg.value_or(moved.yaw_udeg);
  const Workcell& workcell = cell.model().workcell();
  const std::int64_t more_rows =
      camera_rows(workcell, {moved}) - camera_rows(workcell, {cell.state().blocks[*index]});
  if (auto refused = refuse_rows(cell.model(), cell.state(), more_rows)) return *std::move(refused);
  cell.machine.edit().blocks.edit()[*index] = std::move(moved);
  placed_block(cell, "block_move", *index, out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::RemoveBlock& remove, WallNs, CellOutput& out) {
  const auto index = find_block(cell.state(), remove.name);
  if (!index) return no_such_block(cell.state(), remove.name);
  if (is_held(cell.state(), *index)) return block_held(remove.name);
  remove_block(cell.model(), cell.machine.edit(), *index);
  changed_model(cell, "block_remove", remove.name, out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::ReplaceWorkcell& replace, WallNs,
                        CellOutput& out) {
  cell.machine.replace_workcell(cell.model_with(replace.workcell));
  changed_model(cell, "workcell", replace.workcell.name, out);
  return call::Done{};
}

}  // namespace xr3
