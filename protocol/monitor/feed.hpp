// Channels without loss (event, line): a ring buffer keeps the latest messages, numbered over the
// cell's lifetime. A subscription is a cursor into it. A message is converted to text when first
// requested.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

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
  /// Requires first() <= seq < next().
  virtual Message at(std::int64_t seq) = 0;
};

template <class Value>
class Ring : public Feed {
 public:
  using ToMessage = std::function<Message(const Value& value, std::int64_t seq)>;

  /// `most`, above 0, is the capacity.
  Ring(std::size_t most, ToMessage to_message) : slots_(most), to_message_(std::move(to_message)) {}

  /// Adds a value and returns its slot, which still holds the overwritten value. The caller must
  /// fill it at once.
  Value& push() {
    Slot& slot = slot_of(next_++);
    slot.text.reset();
    return slot.value;
  }

  std::int64_t first() const override {
    const auto most = static_cast<std::int64_t>(slots_.size());
    return next_ > most ? next_ - most : 1;
  }
  std::int64_t next() const override { return next_; }
  Message at(std::int64_t seq) override {
    Slot& slot = slot_of(seq);
    if (!slot.text) slot.text = to_message_(slot.value, seq);
    return slot.text;
  }

 private:
  struct Slot {
    Value value;
    Message text;
  };
  Slot& slot_of(std::int64_t seq) { return slots_[static_cast<std::size_t>(seq) % slots_.size()]; }

  std::vector<Slot> slots_;
  ToMessage to_message_;
  std::int64_t next_ = 1;
};

}  // namespace xr3::monitor
