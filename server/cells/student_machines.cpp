#include "server/cells/student_machines.hpp"

#include <algorithm>
#include <utility>

namespace xr3 {

void StudentMachines::note(const asio::ip::address& machine, std::string cell) {
  opened_.insert_or_assign(machine, Opened{std::move(cell), ++last_});
  if (opened_.size() <= kMost) return;
  const auto is_older = [](const auto& one, const auto& other) {
    return one.second.number < other.second.number;
  };
  opened_.erase(std::ranges::min_element(opened_, is_older));
}

std::optional<std::string> StudentMachines::cell_on(const asio::ip::address& machine) const {
  const auto at = opened_.find(machine);
  return at == opened_.end() ? std::nullopt : std::optional(at->second.cell);
}

}  // namespace xr3
