#include "server/cells/registry.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3 {

void CellRegistry::add(CellPtr cell) {
  assert(!find(cell->name()));
  by_name_.emplace(cell->name(), cell);
  if (!cell->token().empty()) by_token_.emplace(sha256_bytes(cell->token()), cell);
  ++total_;
  all_.push_back(std::move(cell));
}

void CellRegistry::remove(const HostedCell& cell) {
  const auto named = by_name_.find(cell.name());
  if (named == by_name_.end() || named->second.get() != &cell) return;
  std::erase(all_, named->second);
  if (!cell.token().empty()) by_token_.erase(sha256_bytes(cell.token()));
  by_name_.erase(named);
}

CellPtr CellRegistry::find(std::string_view name) const {
  const auto named = by_name_.find(name);
  return named == by_name_.end() ? nullptr : named->second;
}

// The search takes a time that depends on digests, which an attacker cannot choose by a token.
CellPtr CellRegistry::find_by_token(std::string_view token) const {
  const auto found = by_token_.find(sha256_bytes(token));
  return found == by_token_.end() ? nullptr : found->second;
}

bool CellRegistry::has_news_to_come() const {
  return std::ranges::any_of(all_,
                             [](const CellPtr& each) { return each->cell().has_news_to_come(); });
}

}  // namespace xr3
