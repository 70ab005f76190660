// The cells that the server serves, by name.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cell/sha256.hpp"
#include "server/cells/hosted_cell.hpp"

namespace xr3 {

class CellRegistry {
 public:
  /// Precondition: no cell has its name.
  void add(CellPtr cell);
  /// No effect if there is no such cell.
  void remove(const HostedCell& cell);

  /// In the order in which they were added.
  const std::vector<CellPtr>& all() const { return all_; }
  bool is_empty() const { return all_.empty(); }
  std::size_t size() const { return all_.size(); }
  /// The number of cells since the start.
  std::uint64_t total() const { return total_; }
  /// nullptr if there is no such cell.
  CellPtr find(std::string_view name) const;
  /// The cell with this token; nullptr if no cell has it. The time does not depend on the tokens.
  CellPtr find_by_token(std::string_view token) const;

  /// Whether there is exactly one cell, from the start to the end of the process.
  bool is_single() const { return !is_dynamic_ && all_.size() == 1; }
  /// Cells will come and go.
  void note_dynamic() { is_dynamic_ = true; }

  /// Whether time alone can change any cell; see Cell::has_news_to_come().
  bool has_news_to_come() const;

 private:
  std::vector<CellPtr> all_;
  std::map<Sha256, CellPtr> by_token_;
  std::uint64_t total_ = 0;
  bool is_dynamic_ = false;
  std::map<std::string, CellPtr, std::less<>> by_name_;
};

}  // namespace xr3
