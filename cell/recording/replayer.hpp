// Applies the entries of a recording to a fresh cell, without wall time, and compares what comes of
// them: the replies of each line with their ticks, and the digests of the state.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "cell/recording/difference.hpp"
#include "cell/recording/state_hash.hpp"
#include "protocol/recording/entry.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// Gives a fresh cell, made with the header's model and clock, the rest of what the header says.
/// Precondition: no input has acted.
void prepare_replay(Cell& cell, const recording::Header& header);
/// The clock of that cell.
SimClock replay_clock(const recording::Header& header);

/// What a replay compares with its entries: replies and digests; replies, because the digests have
/// another version's format; or nothing, because the entries hold only inputs.
enum class Compared : std::uint8_t { kAll, kReplies, kNothing };

class Replayer : private CellObserver {
 public:
  /// `cell` must be prepared, or restored from a checkpoint, and outlive the replayer.
  Replayer(Cell& cell, Compared compared);
  ~Replayer() override;

  /// Calls `sample` at the multiples of `every` ticks of each epoch, as far as time passes, before
  /// what happens at that tick.
  void sample_every(Tick every, std::function<void(const Cell&)> sample);
  /// The replay goes no further than this time: see apply().
  void stop_at(const ReplayTime& time) { stop_ = time; }

  /// Applies an entry. Returns the first difference, after which nothing more is applied. An entry
  /// after the time to stop is not applied, and ends the replay; is_stopped() then.
  std::optional<Difference> apply(const recording::Entry& entry);
  /// Lets time pass to the tick at which the replay must stop, if the clock is real.
  void run_to_stop();

  bool is_stopped() const { return is_stopped_; }
  std::uint64_t inputs() const { return inputs_; }

 private:
  struct Applier;
  struct OutputRun {
    Tick tick;
    std::string bytes;
  };
  using Result = std::optional<Difference>;

  void happened(const Cell& cell, const CellOutput& output) override;

  ReplayTime now() const { return {cell_.epoch(), cell_.state().tick}; }
  Result difference(std::string what, std::string expected, std::string found,
                    std::optional<LineId> line = {}) const;
  Result carry_on(const recording::Entry& entry);
  Result pass_to(const recording::Entry& entry);
  void pass(Tick tick);
  void sample();
  Result make_call(const call::Call& call);
  Result rewind(const SavedCell& saved);
  Result step(const call::Step& step);
  Result run_until(const call::RunUntil& run);
  Tick tick_limit(Tick wanted) const;
  bool has_sample(Tick target) const;
  Result compare_replies(LineId line, Tick tick, std::string_view expected);
  Result refuse_other_replies() const;
  Result compare_hash(const std::string& expected);
  Result leave_unsent(LineId line, std::size_t unsent);
  std::size_t take(const recording::LineInput& input);

  Cell& cell_;
  Compared compared_;
  StateHasher hasher_;
  bool is_stopped_ = false;
  std::uint64_t inputs_ = 0;
  std::optional<ReplayTime> stop_;
  Tick every_ = 0;  ///< 0: no samples
  std::function<void(const Cell&)> sample_;
  ReplayTime next_sample_;
  std::map<LineId, std::deque<OutputRun>>
      replies_;  ///< that no entry has matched yet; none is empty
};

}  // namespace xr3
