#include "server/lines/session.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "server/lines/turns.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// Maximum number of bytes of one line per turn, so that a flood leaves time for the other lines.
// Garbage costs more than 100 ns a byte, since every piece of it is reported.
constexpr std::size_t kBytesATurn = 256;
// Maximum time of one line per turn: an image costs a thousand times as much as the byte that
// requests it. A turn can exceed it by one piece of 64 bytes, or by one full outbox. The clock does
// not affect the state: it only decides which bytes act now and which in the next turn.
constexpr WallNs kFairTime = 150'000;

// After so many arrived bytes, reading ends when a read gives nothing, not when one gives less than
// was wanted: the rest of a burst that is larger than the receive buffer arrives during the read.
constexpr std::size_t kBurst = 2048;

// Maximum time of arrived bytes that move time: each may cost as much as a step of time. It is so
// long that a busy machine does not decide how many bytes act before a call.
constexpr WallNs kArrivedTime = 1'000'000'000;

constexpr std::uint64_t kAllOutput = std::numeric_limits<std::uint64_t>::max();

}  // namespace

LineSession::LineSession(std::unique_ptr<LineStream> stream, const LineOpened& opened,
                         LineSessionContext& context, LineSource& source, PeerCounts::Place place)
    : stream_(std::move(stream)),
      place_(std::move(place)),
      peer_(context.turns.peer(place_.get())),
      id_(context.cell.apply(opened, wall_now()).line),
      context_(context),
      source_(source),
      load_(kNewLoad, wall_now()) {
  report_settings(wall_now());
}

bool LineSession::run_turn(WallNs now) {
  load_.begin_turn();
  Limits turn{fair_share(), kAllOutput, now + kFairTime};
  return work(turn, now) == Left::kSome;
}

// The first bytes are examined together; the time of the turn is limited all the same.
std::size_t LineSession::fair_share() const {
  const bool is_first = is_open_ && context_.cell.find_line(id_)->bytes_in() == 0;
  return is_first ? kFirstChunk : kBytesATurn;
}

LineSession::Limits LineSession::arrived_limits() const {
  const std::uint64_t output = context_.cell.find_line(id_)->output_end();
  const std::size_t most = std::min(kMaxArrived, stream_->max_settled());
  return {most, output + kMaxAnswered, moves_time() ? wall_now() + kArrivedTime : kNever};
}

bool LineSession::read_arrived(Limits& limits, std::size_t most) {
  if (!is_open_) return false;
  Limits round = limits;
  round.most_read = std::min(most, limits.most_read);
  const WallNs now = wall_now();
  if (moves_time()) round.end = std::min(limits.end, now + kFairTime);
  round.is_burst = kMaxArrived - limits.most_read >= kBurst;
  limits.most_read -= round.most_read;
  const Left left = work(round, now);
  limits.most_read += round.most_read;  // what was not read
  return left == Left::kSome;
}

bool LineSession::moves_time() const { return context_.cell.clock().mode() == ClockMode::kBytes; }

LineSession::Left LineSession::work(Limits& limits, WallNs now) {
  const Left left = read_and_act(limits, now);
  if (left != Left::kSome) stream_->acknowledge();
  return left;
}

// Does not read while replies are unsent, so that a client must read its replies. Reads at least
// once, however late it is: else a line would never be read on a machine that is too slow. The
// first bytes act at the time at which the turn began; an inquiry needs no other look at the clock.
LineSession::Left LineSession::read_and_act(Limits& limits, WallNs now) {
  bool has_more = true;
  bool has_read = false;
  for (;;) {
    const Left left = flush(limits, now);
    if (left != Left::kNothing) return left;
    if (!has_more || has_ended_) return Left::kNothing;
    if (has_read) now = wall_now();
    if (limits.most_read == 0 || (has_read && is_over(limits, now))) return Left::kSome;
    has_read = true;
    const std::size_t wanted = std::min(limits.most_read, context_.turns.scratch().size());
    const std::size_t count = read(wanted);
    act({context_.turns.scratch().data(), count}, limits, now);
    has_more = count == wanted || (count > 0 && (limits.is_burst || is_ending_));
    limits.most_read -= count;
  }
}

bool LineSession::is_over(const Limits& limits, WallNs now) const {
  return context_.cell.find_line(id_)->output_end() >= limits.output_end || now >= limits.end;
}

// Reads into the scratch buffer. 0: no bytes now, or, if has_ended_, no more at all.
std::size_t LineSession::read(std::size_t most) {
  const std::size_t count = stream_->read(context_.turns.scratch().first(most));
  has_ended_ = stream_->has_ended();
  if (stream_->is_lost()) close(LineCloseReason::kError);
  return count;
}

void LineSession::act(std::string_view bytes, const Limits& limits, WallNs now) {
  if (bytes.empty()) return;
  report_settings(now);
  const auto is_enough = [&limits] { return wall_now() >= limits.end; };
  const std::size_t taken = context_.cell.apply(BytesIn{id_, bytes, is_enough}, now).bytes_taken;
  const std::size_t held = held_bytes();
  note(context_.turns.memory(), held);
  note_load(taken, held);
  if (moves_time()) load_.add(static_cast<std::uint64_t>(wall_now() - now));
  source_.line_acted(id_);
  context_.acted(id_);
  if (!is_open_) return;
  const SerialLine& line = *context_.cell.find_line(id_);
  if (line.is_not_a_robot_program()) return close(LineCloseReason::kNotARobotProgram);
  if (line.is_cut()) return end_by_fault();
  if (taken < bytes.size()) keep(bytes.substr(taken));
}

// An estimate, since reading the clock would cost more than an inquiry.
void LineSession::note_load(std::uint64_t bytes_in, std::uint64_t bytes_out) {
  constexpr std::uint64_t kPerByteIn = 100;
  constexpr std::uint64_t kPerByteOut = 4;  // made, kept, and sent to the kernel
  load_.add(bytes_in * kPerByteIn + bytes_out * kPerByteOut);
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

// What has acted is still answered; no more bytes are read.
void LineSession::end_by_fault() {
  if (!std::exchange(has_ended_, true)) end_ = LineCloseReason::kFault;
  pending_.clear();
}

void LineSession::report_settings(WallNs now) {
  if (const auto settings = stream_->take_settings(id_)) context_.cell.apply(*settings, now);
}

void LineSession::end_input() {
  if (context_.cell.find_line(id_)->has_input_ended()) return;
  context_.cell.apply(InputEnded{id_}, wall_now());
  context_.acted(id_);
}

// Sends as much as the stream accepts now, and applies the bytes that waited for room in the
// outbox.
LineSession::Left LineSession::flush(const Limits& limits, WallNs now) {
  if (!is_open_) return Left::kWaits;
  const SerialLine& line = *context_.cell.find_line(id_);  // exists while the stream is open
  if (line.is_cut()) end_by_fault();
  const bool is_unread = !has_ended_ && context_.cell.is_unread(id_);
  if (is_unread && !is_broken_) return Left::kWaits;
  if (has_ended_) end_input();
  if (!is_open_) return Left::kWaits;
  if (is_broken_ && (is_unread || line.is_paced() || line.holds_replies())) {
    close(LineCloseReason::kError);
    return Left::kWaits;
  }
  const auto accepts_pending = [&] { return !pending_.empty() && line.accepts(pending_.front()); };
  const auto is_done = [&] { return line.outbox().empty() && pending_.empty(); };
  while (!is_done()) {
    if (line.outbox().empty() && !accepts_pending()) {  // suspended replies, or the device
      const bool may_end = is_ending_ || stream_->is_hung_up();
      if (!may_end || line.has_input_ended()) return Left::kWaits;
      end_input();
    }
    const std::size_t count = line.outbox().empty() ? 0 : stream_->write(line.outbox());
    if (stream_->is_lost()) close(LineCloseReason::kError);
    if (!is_open_) return Left::kWaits;
    context_.cell.sent({id_, count});
    if (line.is_paced()) context_.acted(id_);  // bytes may act again
    if (!is_open_) return Left::kWaits;
    if (count == 0 && !line.outbox().empty()) return Left::kWaits;
    if (is_done()) break;
    now = wall_now();
    if (accepts_pending()) act(std::exchange(pending_, {}), limits, now);
    if (!is_open_) return Left::kWaits;
    if (!is_done() && is_over(limits, wall_now())) return Left::kSome;
  }
  // The replies to bytes that have arrived leave before the line is closed.
  if (has_ended_ && (line.is_drained() || end_ == LineCloseReason::kShutdown)) close(end_);
  return is_open_ ? Left::kNothing : Left::kWaits;
}

std::size_t LineSession::held_bytes() const {
  const SerialLine* line = context_.cell.find_line(id_);
  return line == nullptr ? 0 : line->outbox().size() + line->held_bytes() + pending_.size();
}

void LineSession::finish() {
  has_ended_ = true;
  end_ = LineCloseReason::kShutdown;
  pending_.clear();
  flush({0, kAllOutput, kNever}, wall_now());
}

void LineSession::close(LineCloseReason reason) {
  if (!std::exchange(is_open_, false)) return;
  stream_->close();
  context_.cell.apply(LineClosed{id_, reason}, wall_now());
  context_.ended(id_, reason);
}

}  // namespace xr3
