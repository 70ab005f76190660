// The bytes of a serial line that are under way, at the speed of a serial port: received bytes that
// have not acted yet, and replies that have not arrived yet. Each direction has a queue and a
// transmitter. Bounded by its user: see accepts_input() and are_replies_full().
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "cell/line/reply_hold.hpp"
#include "cell/line/transmitter.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// A byte of data with its offset in all bytes of the line's input.
struct ReceivedByte {
  std::uint8_t byte = 0;
  std::uint64_t offset = 0;
  bool operator==(const ReceivedByte&) const = default;
};

/// A byte of a reply. The last byte of the reply has its meaning.
struct ReplyByte {
  char byte = 0;
  bool is_first = false;
  std::optional<wire::Meaning> meaning;
};

class LinePace {
 public:
  /// With this many received bytes, the line accepts no byte of data until one has acted.
  static constexpr std::size_t kMaxInput = 4096;

  explicit LinePace(const CharacterTime& time) : input_clock_(time), reply_clock_(time) {}

  /// The bytes under way take this time from now on.
  void set_time(const CharacterTime& time);

  bool accepts_input() const { return input_.size() < kMaxInput; }
  void add_input(ReceivedByte byte, Micros now);
  /// Removes the byte that is due. Precondition: due(kIn) has a value.
  ReceivedByte take_input();
  void discard_input();
  /// The byte that acts next. Precondition: there is one.
  const ReceivedByte& next_input() const { return input_.front(); }
  std::size_t input_bytes() const { return input_.size(); }

  /// With so many bytes of replies under way, no byte should act. One reply may exceed it.
  bool are_replies_full() const { return replies_.size() >= ReplyHold::kFull; }
  void add_reply(std::string_view reply, const wire::Meaning& meaning, Micros now);
  /// Removes the byte that is due. Precondition: due(kOut) has a value.
  ReplyByte take_reply_byte();
  void discard_replies();
  std::size_t reply_bytes() const { return replies_.size(); }

  bool is_empty() const { return input_.empty() && replies_.empty(); }

  /// When the next byte is due; nullopt: there is none, or the direction is halted.
  std::optional<Micros> due(Direction direction) const;

  /// While a direction is halted, none of its bytes is due. Its first byte takes its whole time
  /// after that.
  void halt(Direction direction, bool is_halted, Micros now);
  bool is_halted(Direction direction) const {
    return direction == Direction::kIn ? is_input_halted_ : are_replies_halted_;
  }

  /// Time has jumped to `now`: the bytes under way start again.
  void restart(Micros now);

  /// Without the meaning of replies, which no byte depends on.
  void write_state(StateWriter& out) const;
  bool operator==(const LinePace&) const = default;

 private:
  /// The end of a reply in the queue, or of several with one meaning.
  struct ReplyEnd {
    std::size_t bytes;
    wire::Meaning meaning;
    bool operator==(const ReplyEnd&) const = default;
  };

  void start(Direction direction, Micros now);
  void add_end(std::size_t bytes, const wire::Meaning& meaning);

  std::deque<ReceivedByte> input_;
  Transmitter input_clock_;
  bool is_input_halted_ = false;
  std::deque<char> replies_;
  std::deque<ReplyEnd> ends_;  ///< of the replies, in their order
  std::size_t taken_ = 0;      ///< bytes of the first reply that have left the queue
  Transmitter reply_clock_;
  bool are_replies_halted_ = false;
};

}  // namespace xr3
