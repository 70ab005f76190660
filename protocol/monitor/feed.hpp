// Channels without loss (event, line): a ring buffer keeps the latest messages, numbered over the
// cell's lifetime, and grows as it is filled. A subscription is a cursor into it. A message is
// converted to text when first requested.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "protocol/monitor/byte_budget.hpp"
#include "protocol/monitor/message.hpp"

namespace xr3::monitor {

/// Read access to a ring: messages by their seq, from 1.
class Feed {
 public:
  virtual ~Feed() = default;
  /// The oldest seq in the ring; next() if it is empty.
  virtual std::int64_t first() const = 0;
  /// The seq of the next message.
  virtual std::int64_t next() const = 0;
  /// The message as text. Precondition: first() <= seq < next().
  virtual Message at(std::int64_t seq) = 0;
};

/// A ring that grows from nothing to its capacity, as far as the budget allows; then it overwrites
/// its oldest messages.
template <class Value>
class Ring final : public Feed, private ByteBudget::Account {
 public:
  using ToMessage = std::function<Message(const Value& value, std::int64_t seq)>;

  /// `most`, above 0, is the capacity. `heap_bytes` is an estimate of the memory of a message
  /// outside of its slot. `budget` must outlive the ring; nullptr if unlimited.
  Ring(std::size_t most, ToMessage to_message, ByteBudget* budget = nullptr,
       std::size_t heap_bytes = 0)
      : most_(most),
        slot_bytes_(sizeof(Slot) + heap_bytes),
        to_message_(std::move(to_message)),
        budget_(budget) {}
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;
  ~Ring() override {
    if (budget_ != nullptr) budget_->release(*this);
  }

  /// Adds a value and returns its slot, which may still hold the overwritten value. The caller must
  /// fill it at once.
  Value& push() {
    if (count() >= capacity_) grow();
    if (count() >= capacity_) ++first_;
    SegmentPtr& segment = segment_of(next_);
    if (!segment) segment = std::make_unique<Segment>();
    Slot& slot = (*segment)[index_of(next_++)];
    slot.text.reset();
    return slot.value;
  }

  std::int64_t first() const override { return first_; }
  std::int64_t next() const override { return next_; }
  Message at(std::int64_t seq) override {
    assert(first() <= seq && seq < next_);
    Slot& slot = slot_of(seq);
    if (!slot.text) slot.text = to_message_(slot.value, seq);
    return slot.text;
  }
  /// The value of a message. Precondition: first() <= seq < next().
  const Value& value_at(std::int64_t seq) const {
    assert(first() <= seq && seq < next_);
    return slot_of(seq).value;
  }
  /// The number of messages that the ring may keep now.
  std::size_t capacity() const { return capacity_; }

 private:
  struct Slot {
    Value value;
    Message text;
  };
  static constexpr std::size_t kMinCapacity = 16;
  // A segment is allocated when its first slot is needed, and its slots never move. To allocate or
  // move all slots of a large ring at once would take milliseconds.
  static constexpr std::size_t kSegment = 8;
  using Segment = std::array<Slot, kSegment>;
  using SegmentPtr = std::unique_ptr<Segment>;

  /// The number of segments that this number of messages may touch.
  static std::size_t segments_for(std::size_t messages) {
    return (messages + kSegment - 1) / kSegment + 1;
  }
  std::size_t count() const { return static_cast<std::size_t>(next_ - first_); }
  /// The place of a message's segment among `count` segments.
  static std::size_t place_of(std::int64_t seq, std::size_t count) {
    return static_cast<std::size_t>(seq) / kSegment % count;
  }
  /// The place of a message in its segment.
  static std::size_t index_of(std::int64_t seq) { return static_cast<std::size_t>(seq) % kSegment; }
  SegmentPtr& segment_of(std::int64_t seq) { return segments_[place_of(seq, segments_.size())]; }
  Slot& slot_of(std::int64_t seq) const {
    return (*segments_[place_of(seq, segments_.size())])[index_of(seq)];
  }
  std::size_t bytes() const override { return capacity_ * slot_bytes_; }

  // Grows the ring if the budget allows. The first places are always granted: without them nothing
  // could be stored.
  void grow() {
    if (capacity_ >= most_) return;
    const std::size_t wanted = std::min(most_, std::max(kMinCapacity, 2 * capacity_));
    const auto necessity =
        capacity_ == 0 ? ByteBudget::Necessity::kRequired : ByteBudget::Necessity::kUseful;
    if (budget_ == nullptr || budget_->grant(*this, wanted * slot_bytes_, necessity))
      resize(wanted);
  }
  void shrink() override {
    if (capacity_ > kMinCapacity) resize(std::max(kMinCapacity, capacity_ / 2));
  }
  /// Keeps the latest messages.
  void resize(std::size_t size) {
    std::vector<SegmentPtr> segments(segments_for(size));
    first_ = std::max(first_, next_ - static_cast<std::int64_t>(size));
    for (std::int64_t seq = first_; seq < next_; seq = first_of_next_segment(seq))
      segments[place_of(seq, segments.size())] = std::move(segment_of(seq));
    segments_ = std::move(segments);
    capacity_ = size;
  }
  static std::int64_t first_of_next_segment(std::int64_t seq) {
    constexpr auto kSize = static_cast<std::int64_t>(kSegment);
    return (seq / kSize + 1) * kSize;
  }

  std::size_t most_;
  std::size_t slot_bytes_;
  std::size_t capacity_ = 0;
  std::vector<SegmentPtr> segments_;  ///< nullptr if not needed yet
  ToMessage to_message_;
  ByteBudget* budget_;
  std::int64_t first_ = 1;
  std::int64_t next_ = 1;
};

}  // namespace xr3::monitor
