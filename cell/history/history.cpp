#include "cell/history/history.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <utility>

#include "cell/history/heap_size.hpp"

namespace xr3 {
namespace {

// Asked of the budget at once beyond what is needed now.
constexpr std::size_t kMoreBytes = 4096;

/// Blocks and paths that have changed and changed back are equal, but not shared: they are stored
/// once, too.
void share_equal(const Simulation& known, Simulation& machine) {
  const State& last = known.state();
  State& state = machine.edit();
  if (state.blocks == last.blocks) state.blocks = last.blocks;
  if (state.tip_path == last.tip_path) state.tip_path = last.tip_path;
}

/// An estimate of the memory of lines with their queues.
std::size_t bytes_of(const std::map<LineId, SerialLine>& lines) {
  constexpr std::size_t kNode = 64;
  std::size_t bytes = 0;
  for (const auto& [id, line] : lines)
    bytes += sizeof(SerialLine) + kNode + line.outbox().size() + line.held_bytes();
  return bytes;
}

std::size_t bytes_of(const Model& model) { return sizeof(Model) + heap_of(model); }

/// The memory of a snapshot, without a model that is the part's, too.
std::size_t bytes_of(const MachineSnapshot& snapshot, const ModelPtr& known) {
  const State& state = snapshot.state;
  return sizeof(MachineSnapshot) + heap_of(state.blocks) + heap_of(state.tip_path) +
         (snapshot.model == known ? 0 : bytes_of(*snapshot.model));
}

/// The memory of the model and the snapshots of a checkpoint that the next one does not have. Those
/// of the last one are mostly the cell's own.
std::size_t bytes_left(const Rewindable& checkpoint, const Rewindable& later) {
  std::size_t bytes = checkpoint.machine.model_ptr() == later.machine.model_ptr()
                          ? 0
                          : bytes_of(checkpoint.machine.model());
  for (const auto& [name, snapshot] : checkpoint.snapshots) {
    const auto found = later.snapshots.find(name);
    if (found == later.snapshots.end() || found->second != snapshot)
      bytes += bytes_of(*snapshot, checkpoint.machine.model_ptr());
  }
  return bytes;
}

/// The memory of a part, without what it shares with `neighbour`; nullptr: it has none.
std::size_t bytes_of(const HistoryPart& part, const HistoryPart* neighbour) {
  const State& state = part.start.machine.state();
  const State* other = neighbour == nullptr ? nullptr : &neighbour->start.machine.state();
  const bool has_blocks = other == nullptr || !state.blocks.is_shared_with(other->blocks);
  const bool has_path =
      other == nullptr || !state.tip_path.points.is_shared_with(other->tip_path.points);
  return part.fixed_bytes + part.inputs.bytes() + (has_blocks ? heap_of(state.blocks) : 0) +
         (has_path ? heap_of(state.tip_path) : 0);
}

std::shared_ptr<HistoryPart> cut(const HistoryPart& part, const ReplayTime& end) {
  auto rest = std::make_shared<HistoryPart>(part);
  rest->inputs = {};
  part.inputs.for_each([&](const recording::Entry& entry) {
    const bool is_kept = ReplayTime{entry.epoch, entry.tick} <= end;
    if (is_kept) rest->inputs.add(recording::Entry(entry));
    return is_kept;
  });
  return rest;
}

}  // namespace

History::History(Cell& cell, Tick longest, monitor::ByteBudget& budget)
    : Recorder([this](recording::Entry&& entry) { add(std::move(entry)); }, Contents::kInputs),
      cell_(cell),
      longest_(longest),
      budget_(budget) {
  assert(longest > 0 && cell.device() == nullptr);
  cell_.observe(*this);
}

History::~History() {
  cell_.end_observation(*this);
  budget_.release(*this);
}

// --- What it covers.

std::vector<EpochSpan> History::epochs() const {
  std::vector<EpochSpan> all(epochs_.begin(), epochs_.end());
  if (!all.empty()) all.back().to = cell_.state().tick;
  return all;
}

bool History::covers(const ReplayTime& time) const {
  const std::vector<EpochSpan> all = epochs();
  return std::any_of(all.begin(), all.end(), [&time](const EpochSpan& span) {
    return span.epoch == time.epoch && span.from <= time.tick && time.tick <= span.to;
  });
}

/// The first part that begins after a time.
std::deque<History::Part>::const_iterator History::part_after(const ReplayTime& time) const {
  return std::upper_bound(
      parts_.begin(), parts_.end(), time,
      [](const ReplayTime& wanted, const Part& part) { return wanted < part->from(); });
}

// The last part still grows, so it is copied.
HistoryPartPtr History::part_before(const ReplayTime& time) const {
  if (!covers(time)) return nullptr;
  const auto after = part_after(time);
  assert(after != parts_.begin());
  const Part& part = *std::prev(after);
  return part == parts_.back() ? std::make_shared<const HistoryPart>(*part) : part;
}

Tick History::end_of_part(const ReplayTime& time) const {
  assert(covers(time));
  const auto after = part_after(time);
  if (after != parts_.end() && (*after)->from().epoch == time.epoch) return (*after)->from().tick;
  const std::vector<EpochSpan> all = epochs();
  const auto is_same = [&time](const EpochSpan& span) { return span.epoch == time.epoch; };
  return std::find_if(all.begin(), all.end(), is_same)->to;
}

// --- Inputs.

void History::before(const Cell& cell, const Input& input) {
  if (std::holds_alternative<BytesOut>(input)) return Recorder::before(cell, input);
  before_ = now();
  if (before_ != last_) note_motion();  // else nothing has moved since the last input
  if (retry_in_ > 0) --retry_in_;
  if (is_checkpoint_due()) begin_part();
  Recorder::before(cell, input);
}

void History::after(const Cell& cell, const Input& input, const Applied& applied) {
  if (std::holds_alternative<BytesOut>(input)) return;
  const auto* rewind = std::get_if<Rewind>(&input);
  if (const auto* in = std::get_if<BytesIn>(&input)) {
    if (const auto read = read_of(cell, *in, applied))
      add(InputTape::TapeInput{read->at.epoch, read->at.tick, read->at.us, in->line, read->bytes,
                               read->taken, read->unsent});
  } else if (rewind == nullptr) {
    Recorder::after(cell, input, applied);
  }
  note_epoch(before_);
  if (rewind != nullptr) go_back(rewind->from);
  if (back_at_ && !cell.is_in_past()) drop_future();
  note_motion();
  settle();
}

template <class Entry>
void History::add(Entry&& entry) {
  if (parts_.empty()) return;              // memory is short
  assert(parts_.back().use_count() == 1);  // part_before() gives a copy of the last part
  InputTape& inputs = parts_.back()->inputs;
  used_ -= inputs.bytes();
  inputs.add(std::forward<Entry>(entry));
  used_ += inputs.bytes();
}

/// Counts the time since the last input in which something may have moved.
void History::note_motion() {
  const bool is_at_rest = cell_.is_at_rest();
  const bool is_same_epoch = last_.epoch == cell_.epoch();
  if (is_same_epoch && !(was_at_rest_ && is_at_rest)) moved_ += cell_.state().tick - last_.tick;
  was_at_rest_ = is_at_rest;
  last_ = now();
}

// --- Parts and epochs.

bool History::is_checkpoint_due() const {
  if (parts_.empty()) return retry_in_ == 0;
  const HistoryPart& part = *parts_.back();
  return part.from().epoch != cell_.epoch() || moved_ >= kMovedTicks ||
         part.inputs.size() >= kInputs || part.inputs.bytes() >= kInputBytes;
}

void History::begin_part() {
  const std::size_t line_bytes = bytes_of(cell_.lines());
  if (line_bytes > kMaxQueues) return give_up();
  auto part = std::make_shared<HistoryPart>(HistoryPart{cell_.checkpoint(), {}, 0});
  if (!parts_.empty()) share_equal(parts_.back()->start.machine, part->start.machine);
  part->fixed_bytes = sizeof(HistoryPart) + line_bytes;
  if (epochs_.empty()) epochs_.push_back({cell_.epoch(), cell_.state().tick, 0});
  used_ += bytes_of(*part, parts_.empty() ? nullptr : parts_.back().get());
  if (!parts_.empty()) used_ += bytes_left(parts_.back()->start, part->start);
  parts_.push_back(std::move(part));
  moved_ = 0;
  while (parts_.size() > kMaxParts ||
         (parts_.size() > 1 && covered_from(parts_[1]->from()) >= longest_))
    drop_oldest();
}

/// If an input has begun an epoch, the one before ended at `before`.
void History::note_epoch(const ReplayTime& before) {
  if (epochs_.empty() || before.epoch == cell_.epoch()) return;
  epochs_.back().to = before.tick;
  epochs_.push_back({cell_.epoch(), cell_.state().tick, 0});
}

// --- Rewind. An epoch of the past is left without a trace if the cell is taken elsewhere from it.

void History::go_back(const ReplayTime& from) {
  ReplayTime target = from;
  if (back_at_) {
    const Epoch left = before_.epoch;
    if (from.epoch == left) target = *back_at_;
    std::erase_if(epochs_, [left](const EpochSpan& span) { return span.epoch == left; });
    std::erase_if(parts_, [left](const Part& part) { return part->from().epoch == left; });
    recount();
  }
  back_at_ = target;
  begin_part();
}

void History::drop_future() {
  const ReplayTime end = *std::exchange(back_at_, std::nullopt);
  const Epoch current = cell_.epoch();
  std::erase_if(parts_, [&](const Part& part) {
    return part->from() > end && part->from().epoch != current;
  });
  std::erase_if(epochs_, [&](const EpochSpan& span) {
    return ReplayTime{span.epoch, span.from} > end && span.epoch != current;
  });
  for (EpochSpan& span : epochs_)
    if (span.epoch == end.epoch) span.to = std::min(span.to, end.tick);
  const auto last = std::find_if(parts_.rbegin(), parts_.rend(),
                                 [&](const Part& part) { return part->from() <= end; });
  if (last != parts_.rend()) *last = cut(**last, end);
  recount();
}

// --- Memory.

/// Asks for the memory that it has come to use, or gives some back.
void History::settle() {
  if (used_ <= granted_) return;
  if (budget_.grant(*this, used_ + kMoreBytes)) {
    granted_ = used_ + kMoreBytes;
    return;
  }
  while (used_ > granted_ && parts_.size() > 1) drop_oldest();
  if (used_ > granted_) give_up();
}

void History::shrink() {
  parts_.size() > 1 ? drop_oldest() : forget();
  granted_ = used_;
}

/// Counts shared parts once.
void History::recount() {
  used_ = 0;
  const HistoryPart* last = nullptr;
  for (const Part& part : parts_) {
    used_ += bytes_of(*part, last);
    if (last != nullptr) used_ += bytes_left(last->start, part->start);
    last = part.get();
  }
}

/// The time that is covered from a moment on.
Tick History::covered_from(const ReplayTime& begin) const {
  Tick covered = 0;
  for (const EpochSpan& span : epochs()) {
    const Tick from = span.epoch == begin.epoch ? std::max(span.from, begin.tick) : span.from;
    if (span.epoch >= begin.epoch && span.to > from) covered += span.to - from;
  }
  return covered;
}

/// Precondition: there are several parts.
void History::drop_oldest() {
  assert(parts_.size() > 1);
  used_ -= bytes_of(*parts_[0], parts_[1].get()) + bytes_left(parts_[0]->start, parts_[1]->start);
  parts_.pop_front();
  const ReplayTime from = parts_.front()->from();
  while (epochs_.size() > 1 && ReplayTime{epochs_[1].epoch, epochs_[1].from} <= from)
    epochs_.pop_front();
  epochs_.front().from = std::max(epochs_.front().from, from.tick);
}

void History::forget() {
  parts_.clear();
  epochs_.clear();
  back_at_.reset();
  used_ = 0;
}

void History::give_up() {
  forget();
  retry_in_ = kRetryInputs;
}

}  // namespace xr3
