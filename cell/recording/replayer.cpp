#include "cell/recording/replayer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "cell/recording/continued.hpp"

namespace xr3 {
namespace {

using namespace recording;  // NOLINT: the entries have distinct names

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace

std::string to_text(const Difference& difference) {
  std::string text =
      "epoch " + std::to_string(difference.epoch) + ", tick " + std::to_string(difference.tick);
  if (difference.line) text += ", line " + std::to_string(*difference.line);
  return text + ": " + difference.what + ": expected " + difference.expected + ", found " +
         difference.found;
}

SimClock replay_clock(const recording::Header& header) {
  const bool has_byte_clock = header.mode == ClockMode::kBytes || header.byte_clock.has_value();
  SimClock clock = has_byte_clock ? SimClock::bytes() : SimClock::real(header.rate, 0);
  if (header.mode == ClockMode::kManual) clock.pause(0);
  return clock;
}

void prepare_replay(Cell& cell, const recording::Header& header) {
  if (header.byte_clock) {
    cell.set_byte_clock(*header.byte_clock, header.line_speed);
  } else if (header.line_speed) {
    cell.set_line_speed(*header.line_speed);
  }
  if (header.faults) cell.set_faults(*header.faults);
  if (header.device)
    cell.connect_device(header.device->path, header.device->settings, header.device->is_mirrored);
  if (header.start) begin_at_start(cell, header, 0);
}

Replayer::Replayer(Cell& cell, Compared compared) : cell_(cell), compared_(compared) {
  cell_.observe(*this);
  cell_.begin_replay();
}

Replayer::~Replayer() { cell_.end_observation(*this); }

void Replayer::sample_every(Tick every, std::function<void(const Cell&)> sample) {
  assert(every > 0);
  every_ = every;
  sample_ = std::move(sample);
  next_sample_ = now();
}

void Replayer::happened(const Cell&, const CellOutput& output) {
  if (compared_ == Compared::kNothing) return;
  output.for_each_bytes([this](const CellOutput::AddedBytes& added) {
    replies_[added.line].push_back({added.tick, std::string(added.bytes)});
  });
}

Replayer::Result Replayer::difference(std::string what, std::string expected, std::string found,
                                      std::optional<LineId> line) const {
  return Difference{cell_.epoch(),   cell_.state().tick,  line,
                    std::move(what), std::move(expected), std::move(found)};
}

// --- Entries.

Replayer::Result Replayer::apply(const recording::Entry& entry) {
  if (is_stopped_) return std::nullopt;
  if (stop_ && ReplayTime{entry.epoch, entry.tick} > *stop_) {
    is_stopped_ = true;
    return std::nullopt;
  }
  return carry_on(entry);
}

/// Applies an entry to the cell, after time has passed to its tick.
struct Replayer::Applier {
  Replayer& replayer;
  const recording::Entry& entry;

  Result operator()(const LineBegin& begin) const {
    const auto opened = apply(LineOpened{begin.peer, begin.kind, begin.guard});
    if (opened.line == begin.line) return std::nullopt;
    return replayer.difference("number of the line that opens", number(begin.line),
                               number(opened.line));
  }
  Result operator()(const LineInput& input) const {
    if (auto closed = closed_line(input.line)) return closed;
    if (auto other = replayer.leave_unsent(input.line, input.unsent)) return other;
    const std::size_t taken = replayer.take(input);
    if (replayer.is_stopped_) return std::nullopt;
    if (taken != input.taken)
      return replayer.difference("bytes taken", number(input.taken), number(taken), input.line);
    return replayer.compare_replies(input.line, entry.tick, input.replies);
  }
  Result operator()(const LineUnsent& left) const {
    if (auto closed = closed_line(left.line)) return closed;
    return replayer.leave_unsent(left.line, left.unsent);
  }
  Result operator()(const Rewound& rewound) const { return replayer.rewind(*rewound.saved); }
  Result operator()(const CallMade& made) const { return replayer.make_call(made.call); }
  Result operator()(const DeviceInput& in) const { return with_device(DeviceIn{in.bytes}); }
  Result operator()(const DeviceOut& sent) const {
    const DeviceLink* device = replayer.cell_.device();
    const std::size_t waiting = device == nullptr ? 0 : device->outbox().size();
    if (sent.count > waiting)
      return replayer.difference("bytes for the device", "at least " + number(sent.count),
                                 number(waiting));
    return with_device(sent);
  }
  Result operator()(const StateHash& state) const { return replayer.compare_hash(state.hash); }
  Result operator()(const End& end) const {
    return end.hash.empty() ? std::nullopt : replayer.compare_hash(end.hash);
  }
  Result operator()(const DeviceSilent&) const { return std::nullopt; }  // time has passed
  Result operator()(const Replies& replies) const {
    return replayer.compare_replies(replies.line, entry.tick, replies.bytes);
  }
  /// An input of an open line or of the device, as it was recorded.
  Result operator()(const auto& input) const {
    if constexpr (requires { input.line; }) {
      if (auto closed = closed_line(input.line)) return closed;
      apply(input);
      return std::nullopt;
    } else {
      return with_device(input);
    }
  }

 private:
  Applied apply(const Input& input) const {
    ++replayer.inputs_;
    return replayer.cell_.apply(input, 0);
  }
  Result with_device(const Input& input) const {
    if (replayer.cell_.device() == nullptr)
      return replayer.difference("device", "one in the first line", "none");
    apply(input);
    return std::nullopt;
  }
  Result closed_line(LineId line) const {
    if (replayer.cell_.find_line(line) != nullptr) return std::nullopt;
    return replayer.difference("line", "open", "closed", line);
  }
};

Replayer::Result Replayer::carry_on(const recording::Entry& entry) {
  const bool is_output = std::holds_alternative<Replies>(entry.body);
  // What became due at this tick acts before the next input, but after a transport has sent, and
  // not before the end, which is no input.
  const ReplayTime time{entry.epoch, entry.tick};
  const bool is_no_input =
      std::holds_alternative<LineUnsent>(entry.body) || std::holds_alternative<End>(entry.body);
  const bool has_passed = is_output ? time < now() : is_no_input && time == now();
  if (!has_passed) {
    if (auto other = pass_to(entry)) return other;
  }
  if (!is_output && entry.us != cell_.clock_remainder())
    return difference("microseconds", std::to_string(entry.us),
                      std::to_string(cell_.clock_remainder()));
  const auto* end = std::get_if<End>(&entry.body);
  const bool is_cut = end != nullptr && end->hash.empty();  // replies may be missing
  if (!is_output && !is_cut) {
    if (auto other = refuse_other_replies()) return other;
  }
  return std::visit(Applier{*this, entry}, entry.body);
}

/// Applies the bytes of an input, and returns how many were taken. If they take time, and come to
/// the time to stop, the rest is left.
std::size_t Replayer::take(const recording::LineInput& input) {
  ++inputs_;
  const SerialLine& line = *cell_.find_line(input.line);
  const std::uint64_t begin = line.bytes_in();
  const std::uint64_t end = begin + input.taken;
  const bool may_stop =
      stop_ && stop_->epoch == cell_.epoch() && cell_.clock().mode() == ClockMode::kBytes;
  const std::size_t piece =
      may_stop && begin > 0 ? 1 : std::max<std::size_t>(1, input.bytes.size());
  for (std::size_t at = 0; at < input.bytes.size(); at += piece) {
    const auto bytes = std::string_view(input.bytes).substr(at, piece);
    const auto is_enough = [&] { return line.bytes_in() >= end; };
    if (cell_.apply(BytesIn{input.line, bytes}, 0, is_enough).bytes_taken < bytes.size()) break;
    if (line.bytes_in() >= end) break;
    is_stopped_ = may_stop && cell_.state().tick >= stop_->tick;
    if (is_stopped_) break;
  }
  return line.bytes_in() - begin;
}

// --- Time.

Replayer::Result Replayer::pass_to(const recording::Entry& entry) {
  if (entry.epoch != cell_.epoch())
    return difference("epoch", std::to_string(entry.epoch), std::to_string(cell_.epoch()));
  const Tick tick = cell_.state().tick;
  const bool may_pass = cell_.clock().mode() == ClockMode::kReal;
  if (entry.tick < tick || (entry.tick > tick && !may_pass))
    return difference("time", "tick " + std::to_string(entry.tick), "tick " + std::to_string(tick));
  pass(entry.tick);
  return std::nullopt;
}

void Replayer::pass(Tick tick) {
  while (every_ > 0 && next_sample_.epoch == cell_.epoch() && next_sample_.tick <= tick) {
    cell_.replay_to(next_sample_.tick);
    sample();
  }
  cell_.replay_to(tick);
}

/// Takes the sample that is due, and plans the next one.
void Replayer::sample() {
  sample_(cell_);
  next_sample_ = {cell_.epoch(), (cell_.state().tick / every_ + 1) * every_};
}

void Replayer::run_to_stop() {
  if (!stop_ || stop_->epoch != cell_.epoch()) return;
  if (cell_.clock().mode() == ClockMode::kReal) pass(std::max(stop_->tick, cell_.state().tick));
}

}  // namespace xr3
