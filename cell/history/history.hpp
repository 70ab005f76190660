// The past of a cell, from which each of its moments can be made again: a ring of checkpoints, and
// the inputs after each. A checkpoint is taken before an input, after some motion or many inputs,
// so nothing wakes an idle cell, and no moment is far from a checkpoint. The oldest checkpoint is
// dropped if there are too many, or memory is short. Blocks and paths that have not changed are
// shared. Without I/O and wall time.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "cell/history/input_tape.hpp"
#include "cell/recording/recorder.hpp"
#include "protocol/monitor/byte_budget.hpp"

namespace xr3 {

/// A part of a history: what the cell was, and its inputs up to the next part.
struct HistoryPart {
  Rewindable start;
  InputTape inputs;
  std::size_t fixed_bytes = 0;  ///< an estimate of the memory of `start`, without blocks and path

  ReplayTime from() const { return {start.epoch, start.machine.tick()}; }
};
using HistoryPartPtr = std::shared_ptr<const HistoryPart>;

/// The times of one epoch that a history covers, both included.
struct EpochSpan {
  Epoch epoch = 0;
  Tick from = 0;
  Tick to = 0;
};

class History final : private Recorder, private monitor::ByteBudget::Account {
 public:
  /// A checkpoint is taken after so much motion, so many inputs or bytes of inputs.
  static constexpr Tick kMovedTicks = 10 * kTickHz;
  static constexpr std::size_t kInputs = 4096;
  static constexpr std::size_t kInputBytes = std::size_t{512} * 1024;
  /// Maximum number of checkpoints: an hour of motion.
  static constexpr std::size_t kMaxParts = 360;
  /// While the queues of the lines have more bytes, or one part is more than the budget gives, no
  /// history is kept. It begins anew after kRetryInputs if it can.
  static constexpr std::size_t kMaxQueues = std::size_t{16} * 1024 * 1024;
  static constexpr std::size_t kRetryInputs = 256;

  /// Keeps the past `longest` ticks of the cell from now on, within a budget that all histories
  /// share. Preconditions: longest > 0, and the cell has no device. Cell and budget must outlive
  /// the history.
  History(Cell& cell, Tick longest, monitor::ByteBudget& budget);
  History(const History&) = delete;
  History& operator=(const History&) = delete;
  ~History() override;

  /// The times that can be made again, the oldest first, one span for each epoch; empty before the
  /// first input. At most kMaxParts + 1. While the cell is in the past, they include the future to
  /// which it may still return.
  std::vector<EpochSpan> epochs() const;
  bool covers(const ReplayTime& time) const;
  /// The part from which a time can be made again: see past.hpp. It never changes, so another
  /// thread can use it.
  /// nullptr: the history does not cover that time.
  HistoryPartPtr part_before(const ReplayTime& time) const;

  /// The last tick of the same epoch that this part can make. Precondition: covers(time).
  Tick end_of_part(const ReplayTime& time) const;

  /// An estimate of its memory.
  std::size_t used_bytes() const { return used_; }
  /// The number of its parts.
  std::size_t parts() const { return parts_.size(); }

 private:
  using Part = std::shared_ptr<HistoryPart>;

  void before(const Cell& cell, const Input& input) override;
  void after(const Cell& cell, const Input& input, const Applied& applied) override;

  std::size_t bytes() const override { return granted_; }
  void shrink() override;

  std::deque<Part>::const_iterator part_after(const ReplayTime& time) const;
  ReplayTime now() const { return {cell_.epoch(), cell_.state().tick}; }
  template <class Entry>
  void add(Entry&& entry);
  bool is_checkpoint_due() const;
  void begin_part();
  void note_motion();
  void note_epoch(const ReplayTime& before);
  void go_back(const ReplayTime& from);
  void drop_future();
  void settle();
  void recount();
  Tick covered_from(const ReplayTime& begin) const;
  void drop_oldest();
  void forget();
  void give_up();

  Cell& cell_;
  Tick longest_;
  monitor::ByteBudget& budget_;
  std::deque<Part> parts_;
  std::deque<EpochSpan> epochs_;  ///< the last one goes on: its `to` is not valid
  ReplayTime last_;               ///< the end of the last input
  ReplayTime before_;             ///< the begin of the input that acts
  bool was_at_rest_ = true;
  Tick moved_ = 0;            ///< time since the last checkpoint in which something may have moved
  std::size_t retry_in_ = 0;  ///< inputs until the history begins anew
  std::optional<ReplayTime> back_at_;  ///< the cell is in the past, at this time of the history
  std::size_t used_ = 0;
  std::size_t granted_ = 0;
};

}  // namespace xr3
