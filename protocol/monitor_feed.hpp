// Channels of which every message counts: the last of them lie in a ring, numbered over the whole life
// of a cell. A client is a cursor into it. A message becomes text when somebody first asks for it.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "protocol/monitor_message.hpp"

namespace xr3::monitor {

/// What a client sees of a ring: messages by their seq, from 1.
class Feed {
 public:
  virtual ~Feed() = default;
  /// The oldest seq that is still there, or next() where there is none.
  virtual std::int64_t first() const = 0;
  /// The seq that the next message will have.
  virtual std::int64_t next() const = 0;
  /// first() <= seq < next().
  virtual Message at(std::int64_t seq) = 0;
};

template <class Value>
class Ring : public Feed {
 public:
  using ToMessage = std::function<Message(const Value& value, std::int64_t seq)>;

  /// Keeps so many values, above 0.
  Ring(std::size_t most, ToMessage to_message) : slots_(most), to_message_(std::move(to_message)) {}

  /// The place of a new value, in which the oldest one still stands: to be filled at once.
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
