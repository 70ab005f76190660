#include "cell/recording/recorder.hpp"

#include <utility>

#include "cell/digest.hpp"

namespace xr3 {
namespace {

using namespace recording;  // NOLINT: the entries have distinct names

}  // namespace

recording::Header recording_header(const Cell& cell, std::string program) {
  Header header;
  header.program = std::move(program);
  header.state_format = kStateFormat;
  header.cell = cell.name();
  header.model = cell.model_ptr();
  header.mode = cell.clock().mode();
  header.rate = cell.clock().rate();
  header.line_speed = cell.value().line_speed;
  if (const ByteClock* bytes = cell.byte_clock()) {
    header.byte_clock = bytes->settings();
    header.line_speed = bytes->speed();
  }
  if (!(cell.value().initial_faults == FaultPlan{})) header.faults = cell.value().initial_faults;
  if (const DeviceLink* device = cell.device())
    header.device = {device->path(), device->settings(), device->is_mirrored()};
  return header;
}

/// The entry of each kind of input; nullopt: there is none.
struct Recorder::EntryMaker {
  Recorder& recorder;
  const Cell& cell;
  const Applied& applied;

  MaybeBody operator()(const LineOpened& opened) const {
    return LineBegin{applied.line, opened.peer, opened.kind, opened.guard};
  }
  MaybeBody operator()(const BytesIn& in) const {
    const auto read = recorder.read_of(cell, in, applied);
    if (!read) return std::nullopt;
    return LineInput{in.line, std::string(read->bytes), read->taken, read->unsent,
                     recorder.take_replies(in.line)};
  }
  MaybeBody operator()(const DeviceIn& in) const { return DeviceInput{std::string(in.bytes)}; }
  MaybeBody operator()(const DeviceOut& out) const {
    return out.count > 0 ? MaybeBody(out) : std::nullopt;
  }
  MaybeBody operator()(const RecordingFailed&) const { return std::nullopt; }
  MaybeBody operator()(const BytesOut&) const { return std::nullopt; }  // see note_sent()
  MaybeBody operator()(const Rewind& rewind) const {
    const MachineSnapshot& past = *rewind.past;
    return Rewound{std::make_shared<const SavedCell>(
        SavedCell{robot_hash(*past.model), past.model->workcell(), past.state})};
  }
  MaybeBody operator()(const call::Call& call) const {
    if (!std::holds_alternative<call::Done>(applied.outcome)) return std::nullopt;
    return CallMade{call};
  }
  MaybeBody operator()(const auto& same) const { return same; }
};

// --- What happens in the cell.

void Recorder::before(const Cell& cell, const Input& input) {
  if (const auto* sent = std::get_if<BytesOut>(&input)) return note_sent(cell, *sent);
  is_acting_ = true;
  input_at_ = now(cell);
  if (contents_ == Contents::kAll && is_hash_due()) {
    hashed_ = input_at_;
    add(hashed_, StateHash{hasher_.hash(cell)});
  }
  const SerialLine* line = cell.find_line(line_of(input).value_or(0));
  is_open_ = line != nullptr;
  if (!is_open_) return;
  if (std::holds_alternative<BytesIn>(input)) {
    unsent_ = line->outbox().size();
    is_first_ = line->bytes_in() == 0;
  }
}

bool Recorder::is_hash_due() const {
  return input_at_.epoch != hashed_.epoch ||
         input_at_.tick / kHashEvery > hashed_.tick / kHashEvery;
}

void Recorder::after(const Cell& cell, const Input& input, const Applied& applied) {
  is_acting_ = false;
  if (is_open_ || !line_of(input)) {
    if (auto body = std::visit(EntryMaker{*this, cell, applied}, input))
      add(input_at_, *std::move(body));
  }
  add_outputs();
}

/// The first bytes may have been refused.
std::optional<Recorder::TakenBytes> Recorder::read_of(const Cell& cell, const BytesIn& in,
                                                      const Applied& applied) const {
  if (!is_open_) return std::nullopt;
  const bool is_refused = cell.find_line(in.line)->is_not_a_robot_program();
  if (applied.bytes_taken == 0 && !is_refused) return std::nullopt;
  const std::string_view bytes = is_first_ ? in.bytes : in.bytes.substr(0, applied.bytes_taken);
  return TakenBytes{input_at_, bytes, applied.bytes_taken, unsent_};
}

/// When a paced line is full, and goes on, depends on what its transport has sent.
void Recorder::note_sent(const Cell& cell, const BytesOut& out) {
  const SerialLine& line = *cell.find_line(out.line);
  if (!line.is_paced()) return;
  if (out.count == 0 && !line.is_full()) return;
  add(now(cell), LineUnsent{out.line, line.outbox().size() - out.count});
}

void Recorder::happened(const Cell& cell, const CellOutput& output) {
  for (const Tick tick : output.silences) add({cell.epoch(), tick, 0}, DeviceSilent{});
  if (contents_ == Contents::kInputs) return;
  output.for_each_bytes(
      [&](const CellOutput::AddedBytes& added) { add_output(cell.epoch(), added); });
  if (!is_acting_) add_outputs();
}

/// Bytes of a line at one tick are one entry, as far as they fit.
void Recorder::add_output(Epoch epoch, const CellOutput::AddedBytes& added) {
  std::string_view bytes = added.bytes;
  while (!bytes.empty()) {
    Entry* last = outputs_.empty() ? nullptr : &outputs_.back();
    Replies* run = last == nullptr ? nullptr : &std::get<Replies>(last->body);
    const bool is_run = run != nullptr && run->line == added.line && last->tick == added.tick &&
                        last->epoch == epoch && run->bytes.size() < kMaxReplies;
    if (!is_run) {
      outputs_.push_back({epoch, added.tick, 0, Replies{added.line, ""}});
      run = &std::get<Replies>(outputs_.back().body);
    }
    const std::string_view piece = bytes.substr(0, kMaxReplies - run->bytes.size());
    run->bytes += piece;
    bytes.remove_prefix(piece.size());
  }
}

// --- Entries.

recording::Entry Recorder::end_of(const Cell& cell, std::string why) {
  const At at = now(cell);
  return {at.epoch, at.tick, at.us, End{hasher_.hash(cell), std::move(why)}};
}

void Recorder::add(const At& at, recording::EntryBody&& body) {
  sink_({at.epoch, at.tick, at.us, std::move(body)});
}

void Recorder::add_outputs() {
  for (Entry& entry : outputs_) sink_(std::move(entry));
  outputs_.clear();
}

/// The replies of the line to the input that acts, as far as they fit into its entry.
std::string Recorder::take_replies(LineId line) {
  if (outputs_.empty()) return {};
  auto& first = std::get<Replies>(outputs_.front().body);
  if (first.line != line || outputs_.front().tick != input_at_.tick) return {};
  std::string bytes = std::move(first.bytes);
  outputs_.erase(outputs_.begin());
  return bytes;
}

}  // namespace xr3
