// The byte clock of a cell: time that bytes, inquiries and replies take, lines that wait for their
// turn, the robot that runs to rest, and the transcript.
#include <algorithm>
#include <cassert>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

/// Whether the moment of this end is not decided by the client's bytes.
bool is_aborted(LineCloseReason reason) {
  return reason == LineCloseReason::kError || reason == LineCloseReason::kMemory ||
         reason == LineCloseReason::kDisconnected;
}

}  // namespace

void Cell::set_byte_clock(const ByteClockSettings& settings,
                          const std::optional<LineSpeed>& speed) {
  assert(lines_.empty() && !line_speed_ && clock_.running_mode() == ClockMode::kBytes);
  byte_clock_.emplace(settings, speed);
  if (settings.has_concurrent_lines) mark(TranscriptMark::kArrivalOrder);
}

// --- Turns. Lines have their turns in the order in which they were opened.

std::optional<LineId> Cell::current_line() const {
  if (!byte_clock_ || bytes().settings().has_concurrent_lines || lines_.empty())
    return std::nullopt;
  return lines_.begin()->first;
}

std::optional<LineId> Cell::line_before(LineId line) const {
  const std::optional<LineId> current = current_line();
  if (!current || current == line) return std::nullopt;
  return lines_.contains(line) ? current : std::nullopt;
}

/// The line that was obeyed, or the last one, has closed: the robot runs to rest, and the next line
/// has its turn. So nothing depends on whether that line was opened before or after.
void Cell::end_turn(LineCloseReason reason) {
  if (!byte_clock_ || reason == LineCloseReason::kShutdown) return;
  if (is_moved_by_bytes()) rest();
  const std::optional<LineId> next = current_line();
  if (!next) return;
  emit(*next, LineTurnNote{});
  woken_.push_back(*next);
}

// --- Time.

Micros Cell::character_time(const SerialLine& line) const {
  return bytes().character_time(bytes().follows_clients() ? line.settings() : std::nullopt);
}

std::optional<SerialSettings> Cell::speed_of(const SerialLine& line) const {
  return byte_clock_ ? bytes().settings_of(line.settings()) : line.speed();
}

/// Time passes, as long as the byte clock says.
void Cell::pass(Micros time) {
  const Tick ticks = bytes().take_ticks(time);
  if (ticks == 0) return;
  const Tick start = state().tick;
  simulate_to(std::min(start + ticks, monitor::kMaxInteger));
  after_bytes(start);
}

/// Synchronizes clock, counters and events after bytes have moved time from `start`.
void Cell::after_bytes(Tick start) {
  emit_time_events();
  clock_.set_tick(state().tick, 0);
  counters_.ticks += static_cast<std::uint64_t>(state().tick - start);
  if (state().tick != start) ++revision_;
}

/// The replies that have left take their time, and time jumps over what holds back others. No
/// effect unless bytes move time.
void Cell::pass_delays() {
  if (!is_moved_by_bytes() || is_frozen_) return;
  for (;;) {
    pass(bytes().take_owed());
    const std::optional<Tick> due = next_due();
    if (!due) return;
    const Tick start = state().tick;
    advance_to(std::max(*due, start));
    after_bytes(start);
  }
}

/// The robot runs until nothing moves, by at most kMaxSleep. This is bounded work: error counters
/// have 8 bits.
void Cell::rest() {
  pass_delays();
  const Tick start = state().tick;
  run_to_rest(std::min(start + kMaxSleep, monitor::kMaxInteger));
  after_bytes(start);
}

void Cell::handle(const LineSilent& silent, WallNs) {
  const bool moves_time = is_moved_by_bytes() && current_line() == silent.line;
  if (!moves_time || is_in_past_ || simulation_.is_at_rest()) return;
  mark(TranscriptMark::kSilence);
  rest();
}

void Cell::restart_bytes() {
  if (byte_clock_) bytes().restart();
  if (!transcript_) return;
  transcript_->restart();
  if (byte_clock_ && bytes().settings().has_concurrent_lines) mark(TranscriptMark::kArrivalOrder);
  if (!lines_.empty()) mark(TranscriptMark::kNotBytesAlone);  // what has acted depends on time
}

// --- Bytes.

/// Reports what the line has done so far, and lets pass the time that its replies take.
void Cell::pass_before(LineId id, Micros time) {
  emit_exchanges(id, *open_line(id), emitted_);
  emitted_ = exchanges_.size();
  pass(bytes().take_owed() + time);
}

void Cell::byte_comes(LineId id, std::uint8_t byte) {
  const SerialLine* line = find_line(id);
  if (is_moved_by_bytes()) pass_before(id, character_time(*line));
  assert(transcript_);
  if (!line->is_cut()) transcript_->add_in(id, state().tick, byte);
}

void Cell::command_comes(LineId id, const Command& command) {
  if (!is_moved_by_bytes()) return;
  if (is_inquiry(command)) pass_before(id, bytes().inquiry_time());
  if (!bytes().note_command(command, model(), state())) return;
  open_line(id)->note_warning();
  ProblemNote note =
      hurry_note(std::holds_alternative<Move>(command) ? std::get<Move>(command).label
                                                       : std::get<Stop>(command).label);
  ++counters_.warnings[note.code];
  emit_all(id, warnings_.add(id, state().tick, std::move(note)));
}

void Cell::reply_leaves(LineId id, std::string_view reply) {
  assert(transcript_);
  transcript_->add_out(id, state().tick, reply);
  if (is_moved_by_bytes())
    bytes().owe(static_cast<Micros>(reply.size()) * character_time(*find_line(id)));
}

/// As receive_piece(), but of bytes that move time: those up to the end of a command, or of what
/// has arrived of it. What they bring about has happened when this returns.
std::size_t Cell::receive_timed(LineId id, SerialLine& line, std::string_view bytes) {
  const std::uint64_t in_from = line.bytes_in();
  const std::uint64_t out_from = line.output_end();
  const std::optional<TelnetFilter> telnet = line.telnet();
  const std::size_t unsent = line.outbox().size();
  exchanges_.clear();
  emitted_ = 0;
  std::size_t taken = 0;
  while (taken < bytes.size() && exchanges_.empty() && line.outbox().size() == unsent &&
         line.receive(bytes.substr(taken, 1), simulation_, exchanges_) > 0) {
    ++taken;
  }
  if (taken == 0) return 0;
  counters_.bytes_in += taken;
  if (line.has_fault_events()) emit_fault_events(id, line);
  fill_in(wires_.push(), {epoch_, state().tick, id, in_from}, bytes.substr(0, taken), telnet,
          exchanges_, simulation_);
  record_out({epoch_, state().tick, id, out_from}, line, unsent);
  emit_exchanges(id, line, emitted_);
  schedule(id, line);
  pass_delays();
  return taken;
}

// --- The transcript.

void Cell::mark(TranscriptMark mark) {
  if (transcript_) transcript_->mark(mark);
}

void Cell::note_end(LineId line, LineCloseReason reason) {
  if (!transcript_) return;
  transcript_->end_line(line);
  if (is_aborted(reason)) mark(TranscriptMark::kNotBytesAlone);
}

/// A call has changed the cell.
void Cell::note_call(const call::Call& call) {
  if (!call::traits_of(call).keeps_transcript) mark(TranscriptMark::kNotBytesAlone);
  if (is_moved_by_bytes() && lines_.empty()) rest();
}

/// The port of a pseudo-terminal has other settings. Which bytes have acted before depends on time.
void Cell::note_settings(const SerialLine& line, const SerialSettings& reported) {
  const bool is_late = byte_clock_ && bytes().follows_clients() && line.bytes_acted() > 0;
  if (is_late && line.settings() != reported) mark(TranscriptMark::kNotBytesAlone);
}

}  // namespace xr3
