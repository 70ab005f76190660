// The signs by which the overview shows that a program at a cell needs help: its last bytes, its
// last command, the last warning, and the time of a stall. All times are wall time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cell/cell.hpp"
#include "protocol/monitor/overview.hpp"

namespace xr3 {

class Attention final : private CellObserver {
 public:
  /// Begins to observe. The cell must outlive it.
  explicit Attention(Cell& cell) : cell_(cell) { cell_.observe(*this); }
  ~Attention() override { cell_.end_observation(*this); }

  /// Fills in the members of the summary that it knows.
  void describe(monitor::CellSummary& summary) const;

 private:
  void happened(const Cell& cell, const CellOutput& output) override;
  void note(const WireRecord& record);
  std::string_view text_of(const wire::Item& item, std::uint64_t start,
                           const Command& command) const;
  void note_command(std::string_view text, bool has_reply);
  void note(const CellEvent& event, const Model& model);
  void forget();
  void note_warning(std::string_view code, std::string text, std::uint64_t count);

  Cell& cell_;
  std::optional<monitor::UnixMs> last_input_;
  std::optional<monitor::UnixMs> stalled_;
  std::optional<monitor::CommandSummary> command_;
  std::optional<monitor::WarningSummary> warning_;
  std::string_view warning_code_;
  std::string begun_;  ///< bytes that have completed no command yet
  LineId begun_line_ = 0;
};

}  // namespace xr3
