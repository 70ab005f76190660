#include "cell/device/link.hpp"

#include <algorithm>
#include <cassert>

namespace xr3 {
namespace {

constexpr std::int64_t kUsPerSecond = 1'000'000;

/// With start bit, parity bit and stop bits; 12 if the frame is not known.
int bits_per_byte(const SerialSettings& settings) {
  if (!settings.frame) return 12;
  const SerialFrame& frame = *settings.frame;
  return 1 + frame.data_bits + (frame.parity == Parity::kNone ? 0 : 1) +
         (frame.stop_bits == StopBits::kOne ? 1 : 2);
}

std::int64_t time_us(std::size_t bytes, const SerialSettings& settings) {
  const auto bits = static_cast<std::int64_t>(bytes) * bits_per_byte(settings);
  return bits * kUsPerSecond / settings.baud;
}

}  // namespace

DeviceLink::DeviceLink(std::string path, const SerialSettings& settings, bool is_mirrored)
    : path_(std::move(path)), settings_(settings), is_mirrored_(is_mirrored) {
  assert(settings.baud > 0);
}

void DeviceLink::set_open(bool is_open, Tick now) {
  is_open_ = is_open;
  opened_ = now;
  drop();
}

void DeviceLink::engage(bool is_engaged) {
  is_engaged_ = is_engaged;
  ++switches_;
  drop_waiting();
}

void DeviceLink::drop_waiting() {
  for (const auto& [line, queue] : std::exchange(queues_, {})) woken_.push_back(line);
}

void DeviceLink::drop() {
  drop_waiting();
  asked_.reset();
  outbox_.clear();
  busy_until_us_ = 0;
}

bool DeviceLink::accepts(LineId line) const {
  const auto found = queues_.find(line);
  return found == queues_.end() || found->second.bytes < kMaxWaiting;
}

void DeviceLink::add(LineId line, const Command& command, Tick now) {
  if (!is_open_) return;
  auto encoded = for_device(command);
  assert(encoded);
  Queue& queue = queues_[line];
  queue.bytes += encoded->bytes.size();
  queue.commands.push_back({line, command, std::move(*encoded)});
  send_next(now);
}

/// The next command of the line that follows the one served last.
DeviceLink::QueuedCommand DeviceLink::take_next() {
  auto found = queues_.upper_bound(last_served_);
  if (found == queues_.end()) found = queues_.begin();
  auto& [line, queue] = *found;
  last_served_ = line;
  QueuedCommand next = std::move(queue.commands.front());
  queue.commands.pop_front();
  const bool was_full = queue.bytes >= kMaxWaiting;
  queue.bytes -= next.encoded.bytes.size();
  if (was_full && queue.bytes < kMaxWaiting) woken_.push_back(line);
  if (queue.commands.empty()) queues_.erase(found);
  return next;
}

// An inquiry ends the sending until it is answered or forgotten, or a reply could go to the wrong
// line.
void DeviceLink::send_next(Tick now) {
  while (!asked_ && !queues_.empty() && outbox_.size() < kFullOutbox) {
    const QueuedCommand next = take_next();
    send(next.encoded.bytes, now);
    if (!next.encoded.is_inquiry) continue;
    asked_ = PendingInquiry{next.line, next.command};
    asked_until_ = first_tick_after(busy_until_us_) + kPatience;
  }
}

void DeviceLink::send(std::string_view bytes, Tick now) {
  const Micros now_us = micros_at(now);
  busy_until_us_ = std::min(std::max(busy_until_us_, now_us) + time_us(bytes.size(), settings_),
                            now_us + time_us(kMaxHeld, settings_));
  outbox_ += bytes;
  last_ = bytes;
}

std::optional<DeviceLink::PendingInquiry> DeviceLink::receive(Tick now) {
  ++bytes_in_;
  const auto answered = std::exchange(asked_, std::nullopt);
  if (answered) send_next(now);
  return answered;
}

std::optional<Tick> DeviceLink::deadline() const {
  return asked_ ? std::optional(asked_until_) : std::nullopt;
}

std::optional<DeviceLink::PendingInquiry> DeviceLink::expire(Tick now) {
  const auto limit = deadline();
  if (!limit || now < *limit) return std::nullopt;
  const auto silent = std::exchange(asked_, std::nullopt);
  send_next(now);
  return silent;
}

// An inquiry is the last of the outbox. If it has left, its reply may come: it must not be taken
// for that of the next inquiry. Further stops do not let it wait longer.
void DeviceLink::stop(Tick now) {
  ++stops_;
  const auto answered_later = outbox_.empty() ? asked_ : std::nullopt;
  drop();
  asked_ = answered_later;
  if (is_open_) send(stop_all_joints(), now);
  asked_until_ = std::min(asked_until_, first_tick_after(busy_until_us_) + kPatience);
}

void DeviceLink::forget(LineId line) {
  if (asked_ && asked_->line == line) asked_->line.reset();
  const auto found = queues_.find(line);
  if (found == queues_.end()) return;
  for (QueuedCommand& each : found->second.commands) each.line.reset();
}

void DeviceLink::sent(std::size_t count, Tick now) {
  assert(count <= outbox_.size());
  outbox_.erase(0, count);
  bytes_out_ += count;
  send_next(now);
}

void DeviceLink::write_state(StateWriter& out) const {
  out.add(is_open_, is_engaged_, switches_, stops_, last_served_, outbox_, busy_until_us_,
          bytes_in_, bytes_out_, asked_.has_value(), queues_.size());
  if (asked_) out.add(asked_->line, for_device(asked_->command)->bytes);
  const bool is_before_a_stop =
      asked_ && asked_until_ != first_tick_after(busy_until_us_) + kPatience;
  if (is_before_a_stop) out.add(asked_until_);
  for (const auto& [line, queue] : queues_) {
    out.add(line, queue.commands.size());
    for (const QueuedCommand& each : queue.commands) out.add(each.line, each.encoded.bytes);
  }
}

}  // namespace xr3
