#include "server/cells/branch_cells.hpp"

#include <algorithm>
#include <utility>

namespace xr3 {
namespace {

constexpr WallNs kCheckEvery = 1'000'000'000;

bool is_used(HostedCell& cell) {
  return !cell.cell().lines().empty() || !cell.hub().sessions().empty();
}

}  // namespace

void BranchCells::add(CellPtr cell) {
  members_.push_back({std::move(cell), wall_now()});
  if (members_.size() == 1) arm();
}

void BranchCells::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

void BranchCells::arm() {
  if (members_.empty() || is_stopped_) return;
  run_at(timer_, wall_now() + std::min(kCheckEvery, std::max<WallNs>(linger_, 1)),
         [this] { close_unused(); });
}

void BranchCells::close_unused() {
  const WallNs now = wall_now();
  std::vector<CellPtr> unused;
  std::erase_if(members_, [&](Member& each) {
    const bool is_in_use = is_used(*each.cell);
    if (is_in_use) each.used = now;
    const bool goes = !is_in_use && now - each.used >= linger_;
    if (goes) unused.push_back(each.cell);
    return goes;
  });
  for (const CellPtr& cell : unused) close_(cell);
  arm();
}

}  // namespace xr3
