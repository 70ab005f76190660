#include "cell/line/pace.hpp"

#include <cassert>
#include <utility>

namespace xr3 {

void LinePace::set_time(const CharacterTime& time) {
  input_clock_.set_time(time);
  reply_clock_.set_time(time);
}

/// Starts the clock of a direction that has bytes to pass on.
void LinePace::start(Direction direction, Micros now) {
  const bool is_input = direction == Direction::kIn;
  Transmitter& clock = is_input ? input_clock_ : reply_clock_;
  const bool has_bytes = is_input ? !input_.empty() : !replies_.empty();
  if (has_bytes && !is_halted(direction) && !clock.is_busy()) clock.start(now);
}

void LinePace::add_input(ReceivedByte byte, Micros now) {
  assert(accepts_input());
  input_.push_back(byte);
  start(Direction::kIn, now);
}

ReceivedByte LinePace::take_input() {
  assert(due(Direction::kIn));
  const ReceivedByte first = input_.front();
  input_.pop_front();
  input_clock_.complete(!input_.empty());
  return first;
}

void LinePace::discard_input() {
  input_.clear();
  input_clock_.stop();
}

void LinePace::add_reply(std::string_view reply, const wire::Meaning& meaning, Micros now) {
  assert(!reply.empty());
  replies_.insert(replies_.end(), reply.begin(), reply.end());
  add_end(reply.size(), meaning);
  start(Direction::kOut, now);
}

void LinePace::add_end(std::size_t bytes, const wire::Meaning& meaning) {
  constexpr std::size_t kMax = ReplyHold::kMaxItems;
  if (ends_.size() < kMax) return ends_.push_back({bytes, meaning});
  if (ends_.size() == kMax) ends_.push_back({0, wire::MoreAnswers{0}});
  ReplyEnd& rest = ends_.back();
  ++std::get<wire::MoreAnswers>(rest.meaning).count;
  rest.bytes += bytes;
}

ReplyByte LinePace::take_reply_byte() {
  assert(due(Direction::kOut));
  ReplyByte next{replies_.front(), taken_ == 0, std::nullopt};
  replies_.pop_front();
  reply_clock_.complete(!replies_.empty());
  if (++taken_ < ends_.front().bytes) return next;
  next.meaning = std::move(ends_.front().meaning);
  ends_.pop_front();
  taken_ = 0;
  return next;
}

void LinePace::discard_replies() {
  replies_.clear();
  ends_.clear();
  taken_ = 0;
  reply_clock_.stop();
}

std::optional<Micros> LinePace::due(Direction direction) const {
  const Transmitter& clock = direction == Direction::kIn ? input_clock_ : reply_clock_;
  return clock.is_busy() ? std::optional(clock.due()) : std::nullopt;
}

void LinePace::halt(Direction direction, bool is_halted, Micros now) {
  const bool is_input = direction == Direction::kIn;
  (is_input ? is_input_halted_ : are_replies_halted_) = is_halted;
  if (is_halted) return (is_input ? input_clock_ : reply_clock_).stop();
  start(direction, now);
}

void LinePace::write_state(StateWriter& out) const {
  out.add(input_.size(), input_clock_, is_input_halted_);
  for (const ReceivedByte& each : input_) out.add(each.byte, each.offset);
  out.add(std::string(replies_.begin(), replies_.end()), taken_, reply_clock_, are_replies_halted_);
}

void LinePace::restart(Micros now) {
  for (Transmitter* clock : {&input_clock_, &reply_clock_}) clock->stop();
  for (const Direction direction : {Direction::kIn, Direction::kOut}) start(direction, now);
}

}  // namespace xr3
