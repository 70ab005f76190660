#include "server/lines/session.hpp"

#include <spdlog/spdlog.h>

#include <new>
#include <utility>

#include "server/lines/turns.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

LineSession::LineSession(std::unique_ptr<LineStream> stream, const LineOpened& opened,
                         LineSessionContext& context, LineSource& source, PeerCounts::Place place)
    : stream_(std::move(stream)),
      place_(std::move(place)),
      id_(context.cell.apply(opened, wall_now()).line),
      context_(context),
      source_(source) {
  report_settings(wall_now());
}

LineSession::Turn LineSession::run_turn(WallNs now) {
  const Turn turn = read_and_execute(now);
  if (turn != Turn::kMore) stream_->acknowledge();
  return turn;
}

// Does not read while replies are unsent, so that a client must read its replies. Reads once,
// however late it is: else a line would never be read on a machine that is too slow. The bytes act
// at the time at which the turn began; an inquiry needs no other look at the clock.
LineSession::Turn LineSession::read_and_execute(WallNs now) {
  const WallNs end = now + kTurnTime;
  const Turn before = flush(end);
  if (before != Turn::kDrained || has_ended_) return before;
  const std::size_t wanted = turn_bytes();
  const std::size_t count = read(wanted);
  execute({context_.turns.scratch().data(), count}, end, now);
  const Turn after = flush(end);
  const bool may_have_more = count == wanted || (count > 0 && (is_ending_ || stream_->has_more()));
  return after == Turn::kDrained && may_have_more ? Turn::kMore : after;
}

// The first bytes are examined together; the time of the turn is limited all the same.
std::size_t LineSession::turn_bytes() const { return bytes_in() == 0 ? kFirstChunk : kBytesATurn; }

// Reads into the scratch buffer. 0: no bytes now, or, if has_ended_, no more at all.
std::size_t LineSession::read(std::size_t most) {
  const std::size_t count = stream_->read(context_.turns.scratch().first(most));
  has_ended_ = stream_->has_ended();
  if (stream_->is_lost()) close(LineCloseReason::kError);
  return count;
}

void LineSession::execute(std::string_view bytes, WallNs end, WallNs now) {
  if (bytes.empty()) return;
  report_settings(now);
  const auto is_enough = [end] { return wall_now() >= end; };
  const std::size_t taken = context_.cell.apply(BytesIn{id_, bytes}, now, is_enough).bytes_taken;
  note(context_.turns.memory(), held_bytes());
  source_.line_executed(id_);
  context_.on_input(id_);
  if (!is_open()) return;
  const SerialLine& line = *context_.cell.find_line(id_);
  if (line.is_not_a_robot_program()) return close(LineCloseReason::kNotARobotProgram);
  if (line.is_cut()) return end_by_fault();
  if (taken < bytes.size()) keep(bytes.substr(taken));
}

// If memory is exhausted, only this line ends.
void LineSession::keep(std::string_view bytes) {
  try {
    pending_.append(bytes);
  } catch (const std::bad_alloc&) {
    spdlog::error("line {}: no memory for its bytes; it is closed", id_);
    close(LineCloseReason::kError);
  }
}

// Executed bytes are still answered; no more bytes are read.
void LineSession::end_by_fault() {
  if (!std::exchange(has_ended_, true)) end_ = LineCloseReason::kFault;
  pending_.clear();
}

void LineSession::report_settings(WallNs now) {
  if (const auto settings = stream_->changed_settings(id_)) context_.cell.apply(*settings, now);
}

void LineSession::end_input() {
  if (context_.cell.find_line(id_)->has_input_ended()) return;
  context_.cell.apply(InputEnded{id_}, wall_now());
  context_.on_input(id_);
}

/// Whether the replies wait since the cell is frozen. Later ones wait with the first.
bool LineSession::is_held() {
  const bool is_frozen = context_.cell.is_frozen() && end_ != LineCloseReason::kShutdown;
  if (!is_frozen || context_.cell.find_line(id_)->outbox().empty()) {
    held_since_.reset();
    return false;
  }
  const WallNs now = wall_now();
  if (!held_since_) held_since_ = now;
  return now - *held_since_ < kFrozenReply;
}

// Sends as much as the stream accepts now, and applies the bytes that waited for room in the
// outbox.
LineSession::Turn LineSession::flush(WallNs end) {
  if (!is_open()) return Turn::kBlocked;
  const SerialLine& line = *context_.cell.find_line(id_);  // exists while the stream is open
  if (line.is_cut()) end_by_fault();
  const bool waits = !has_ended_ && is_unread(context_.cell.value(), id_);
  if (waits && !is_broken_) return Turn::kBlocked;
  if (has_ended_) end_input();
  if (!is_open()) return Turn::kBlocked;
  const bool is_frozen = is_held();
  if (is_broken_ && (waits || is_frozen || line.is_paced() || line.holds_replies())) {
    close(LineCloseReason::kError);
    return Turn::kBlocked;
  }
  if (is_frozen) return Turn::kBlocked;
  const auto accepts_pending = [&] {
    return !pending_.empty() && accepts(context_.cell.value(), line, pending_.front());
  };
  const auto is_done = [&] { return line.outbox().empty() && pending_.empty(); };
  while (!is_done()) {
    if (line.outbox().empty() && !accepts_pending()) {  // suspended replies, or the device
      if (!is_ending_ || line.has_input_ended()) return Turn::kBlocked;
      end_input();
    }
    const std::size_t count = line.outbox().empty() ? 0 : stream_->write(line.outbox());
    if (stream_->is_lost()) close(LineCloseReason::kError);
    if (!is_open()) return Turn::kBlocked;
    context_.cell.sent({id_, count});
    if (line.is_paced()) context_.on_input(id_);  // further bytes may be due
    if (!is_open()) return Turn::kBlocked;
    if (count == 0 && !line.outbox().empty()) return Turn::kBlocked;
    if (is_done()) break;
    if (accepts_pending()) execute(std::exchange(pending_, {}), end, wall_now());
    if (!is_open()) return Turn::kBlocked;
    if (!is_done() && wall_now() >= end) return Turn::kMore;
  }
  // The replies to bytes that have arrived leave before the line is closed.
  if (has_ended_ && (line.is_drained() || end_ == LineCloseReason::kShutdown)) close(end_);
  return is_open() ? Turn::kDrained : Turn::kBlocked;
}

std::size_t LineSession::arrived_bytes() const {
  return is_open() && !has_ended_ ? pending_.size() + stream_->unread_bytes() : 0;
}

std::size_t LineSession::held_bytes() const {
  const SerialLine* line = context_.cell.find_line(id_);
  return line == nullptr ? 0 : line->outbox().size() + line->held_bytes() + pending_.size();
}

void LineSession::finish() {
  has_ended_ = true;
  end_ = LineCloseReason::kShutdown;
  pending_.clear();
  flush(kNever);
}

void LineSession::close(LineCloseReason reason) {
  if (!is_open()) return;
  stream_->close();
  context_.cell.apply(LineClosed{id_, reason}, wall_now());
  context_.ended(id_, reason);
}

}  // namespace xr3
