// The faults of one serial line: what they make of its bytes, which replies they hold back, and
// whether they cut the line. The faults themselves are in the machine's state; here is what belongs
// to the line: the numbers of its data bytes, replies that wait, and events to report.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

/// A reply that waits because of a fault.
struct DelayedReply {
  Tick due = 0;  ///< unless an XOFF holds it back
  std::string bytes;
  wire::Meaning meaning;
  bool operator==(const DelayedReply&) const = default;
};

class LineFaults {
 public:
  /// With so many replies or bytes waiting, the line takes no more data. One reply may exceed it.
  static constexpr std::size_t kMaxReplies = 1024;
  static constexpr std::size_t kMaxBytes = 64 * 1024;

  /// `line` is the line's number.
  LineFaults(LineId line, const State& state)
      : line_(line), power_cycles_(state.faults.power_cycles) {}

  /// Whether no fault concerns the next data byte of the client. If so, the byte is counted; if
  /// not, receive() must be called.
  bool passes_input(const State& state) {
    if (has_line_faults(state)) return false;
    ++received_;
    return true;
  }
  /// Returns the bytes that arrive at the controller for a data byte of the client. Preconditions:
  /// faults concern lines, and the simulation has no pending events; those of faults are kept here.
  std::string receive(std::uint8_t byte, Simulation& simulation);
  /// Whether the controller has been without power since the last call: it has forgotten the
  /// beginning of a command.
  bool take_power_cycle(const State& state) {
    return std::exchange(power_cycles_, state.faults.power_cycles) != state.faults.power_cycles;
  }

  /// Whether no fault concerns the next reply, of `bytes` bytes, and none waits in front of it. If
  /// so, it is counted; if not, carry() must be called.
  bool passes_reply(const State& state, std::size_t bytes) {
    if (has_line_faults(state) || !waiting_.empty()) return false;
    replied_ += bytes;
    return true;
  }
  /// Returns the bytes that arrive at the client for a reply.
  Carried carry(std::string_view reply, Simulation& simulation);

  /// Whether a reply with this delay must wait: because of a fault, or behind others.
  bool must_wait(const State& state, std::uint32_t delay_ms) const;
  /// Lets a reply wait. Precondition: must_wait().
  void add(const State& state, std::uint32_t delay_ms, DelayedReply reply);
  /// The tick at which the first waiting reply is due, as far as it is known.
  std::optional<Tick> due(const State& state) const;
  /// Removes the first waiting reply if it is due now.
  std::optional<DelayedReply> take_due(const State& state);
  /// Forgets the waiting replies.
  void discard();
  /// Time has jumped: what waits is due at once, unless an XOFF holds it back.
  void restart(Tick now);

  bool is_empty() const { return waiting_.empty(); }
  bool is_full() const { return waiting_.size() >= kMaxReplies || bytes_ >= kMaxBytes; }
  /// The memory of the waiting replies.
  std::size_t held_bytes() const { return waiting_.size() * sizeof(DelayedReply) + bytes_; }

  /// The line is disconnected by a fault: it takes no more bytes, and what waits is lost.
  void cut() {
    is_cut_ = true;
    discard();
  }
  bool is_cut() const { return is_cut_; }

  bool has_events() const { return !events_.empty(); }
  /// Removes and returns the events of the faults, in order.
  Events take_events() { return std::exchange(events_, {}); }

  void write_state(StateWriter& out) const {
    out.add(power_cycles_, received_, replied_, is_cut_, waiting_.size());
    for (const DelayedReply& reply : waiting_) out.add(reply.due, reply.bytes);
  }

  bool operator==(const LineFaults&) const = default;

 private:
  void keep_events(Simulation& simulation);

  LineId line_;
  std::uint32_t power_cycles_;       ///< of the state, as far as the line knows
  std::uint64_t received_ = 0;       ///< data bytes of the client
  std::uint64_t replied_ = 0;        ///< bytes of replies
  std::list<DelayedReply> waiting_;  ///< no memory while it is empty
  std::size_t bytes_ = 0;            ///< of waiting_
  bool is_cut_ = false;
  Events events_;
};

}  // namespace xr3
