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

const std::string& BranchCells::origin_of(const HostedCell& cell) const {
  const auto is_this = [&cell](const KeptBranch& each) { return each.cell.get() == &cell; };
  const auto member = std::ranges::find_if(members_, is_this);
  return member == members_.end() ? cell.name() : member->origin;
}

std::size_t BranchCells::count(const std::string& origin) const {
  return static_cast<std::size_t>(std::ranges::count(members_, origin, &KeptBranch::origin));
}

std::string BranchCells::next_name(const std::string& origin) {
  const std::string end = "-b" + std::to_string(++named_[origin]);
  return origin.substr(0, kMaxCellName - end.size()) + end;
}

void BranchCells::add(CellPtr cell, std::string origin) {
  members_.push_back({std::move(cell), std::move(origin), wall_now()});
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
  std::erase_if(members_, [&](KeptBranch& each) {
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
