#include "core/faults/line_faults.hpp"

#include <algorithm>
#include <bit>

#include "core/faults/chance.hpp"
#include "core/faults/effects.hpp"

namespace xr3 {
namespace {

constexpr unsigned kBitsOfAByte = 8;
constexpr unsigned kParityBit = 0x80;
constexpr unsigned kDataBits = 0x7F;

/// The second number of a chance: line and direction come first, see number_of().
std::uint64_t number_of(const LinePlace& place) {
  return std::uint64_t{place.line} << 1 | (place.side == LineSide::kOut ? 1U : 0U);
}

bool has_direction(FaultKind kind) {
  return kind == FaultKind::kByteDropped || kind == FaultKind::kByteFlipped ||
         kind == FaultKind::kByteDoubled || kind == FaultKind::kStrayByte ||
         kind == FaultKind::kParityError;
}

bool is_of_line(const Fault& fault, std::uint32_t line) {
  return fault.line == 0 || fault.line == line;
}

/// Whether the fault has an effect on this byte or reply now.
bool acts(const State& state, const FaultState& each, const LinePlace& place) {
  const Fault& fault = each.fault;
  if (!is_of_line(fault, place.line) || place.offset < fault.after_bytes.value_or(0)) return false;
  if (has_direction(fault.kind) && fault.direction != place.side) return false;
  return acts_on(state, each, number_of(place), place.offset);
}

std::uint8_t flipped(const FaultState& each, const LinePlace& place, std::uint8_t byte) {
  const auto by_chance =
      static_cast<unsigned>(chance_hash(~each.salt, number_of(place), place.offset)) %
      (kBitsOfAByte - 1);
  const unsigned bit = each.fault.bit ? static_cast<unsigned>(*each.fault.bit) : by_chance;
  return static_cast<std::uint8_t>(byte ^ 1U << bit);
}

/// The byte with one bit flipped, so that it differs from the one sent.
std::uint8_t garbled(const FaultState& each, const LinePlace& place, std::uint8_t byte) {
  const auto change = static_cast<std::uint8_t>(
      chance_hash(each.salt, number_of(place), place.offset) % UINT8_MAX + 1);
  return byte ^ change;
}

/// 7 data bits with even parity, read as 8 data bits without.
std::uint8_t with_parity_bit(std::uint8_t byte) {
  const unsigned data = byte & kDataBits;
  return static_cast<std::uint8_t>(std::popcount(data) % 2 == 0 ? data : data | kParityBit);
}

class FaultyLine {
 public:
  FaultyLine(const Model& model, State& state, Events& events)
      : model_(model), state_(state), events_(events) {}

  /// Adds the byte to the result, changed by the faults of bytes.
  void carry(const LinePlace& place, std::uint8_t byte, Carried& carried) {
    std::size_t copies = 1;
    for (FaultState& each : state_.faults.all) {
      if (copies > 0 && is_of_bytes(each.fault.kind) && acts(state_, each, place))
        alter(each, place, byte, copies, carried);
    }
    carried.bytes.append(copies, static_cast<char>(byte));
  }

  void disconnect(const LinePlace& place, Carried& carried) {
    for (FaultState& each : state_.faults.all) {
      const bool is_due = each.fault.kind == FaultKind::kLineDisconnected && !each.fault.at_tick &&
                          acts(state_, each, place);
      if (!is_due) continue;
      add(each, place);
      carried.is_disconnected = true;
    }
  }

  /// Whether the whole reply is lost.
  bool loses(const LinePlace& place) {
    for (FaultState& each : state_.faults.all) {
      if (each.fault.kind != FaultKind::kReplyLost || !acts(state_, each, place)) continue;
      add(each, place);
      return true;
    }
    return false;
  }

  std::uint32_t delay_ms(const LinePlace& place) {
    std::uint32_t delay = 0;
    for (FaultState& each : state_.faults.all) {
      if (each.fault.kind != FaultKind::kReplyDelayed || !acts(state_, each, place)) continue;
      add(each, place);
      delay = std::max(delay, each.fault.delay_ms);
    }
    return delay;
  }

  std::string strays(const LinePlace& place) {
    std::string bytes;
    for (FaultState& each : state_.faults.all) {
      if (each.fault.kind != FaultKind::kStrayByte || !acts(state_, each, place)) continue;
      add(each, place);
      bytes.push_back(static_cast<char>(each.fault.byte));
    }
    return bytes;
  }

 private:
  static bool is_of_bytes(FaultKind kind) {
    return kind == FaultKind::kByteDropped || kind == FaultKind::kByteFlipped ||
           kind == FaultKind::kByteDoubled || kind == FaultKind::kParityError ||
           kind == FaultKind::kWrongBaud || kind == FaultKind::kWrongParity;
  }

  void alter(FaultState& each, const LinePlace& place, std::uint8_t& byte, std::size_t& copies,
             Carried& carried) {
    switch (each.fault.kind) {
      case FaultKind::kByteDropped: copies = 0; break;
      case FaultKind::kByteFlipped: byte = flipped(each, place, byte); break;
      case FaultKind::kByteDoubled: copies = 2; break;
      case FaultKind::kWrongBaud: byte = garbled(each, place, byte); break;
      case FaultKind::kWrongParity: byte = with_parity_bit(byte); break;
      case FaultKind::kParityError:
        carried.has_parity_error = true;
        byte = 0;
        if (place.side == LineSide::kIn) copies = 0;
        break;
      default: break;
    }
    add(each, place);
  }

  void add(FaultState& each, const LinePlace& place) {
    add_effect(model_, state_, each, 0, static_cast<std::int64_t>(place.offset), events_);
  }

  const Model& model_;
  State& state_;
  Events& events_;
};

/// The faults in force of one kind that hold back replies of a line.
template <class Take>
void for_each_hold(const State& state, FaultKind kind, std::uint32_t line, const Take& take) {
  for (const FaultState& each : state.faults.all) {
    if (each.is_on && each.fault.kind == kind && is_of_line(each.fault, line)) take(each.fault);
  }
}

}  // namespace

Carried carry_input(const Model& model, State& state, const LinePlace& place, std::uint8_t byte,
                    Events& events) {
  FaultyLine carrier(model, state, events);
  Carried carried;
  carrier.carry(place, byte, carried);
  carrier.disconnect(place, carried);
  return carried;
}

Carried carry_reply(const Model& model, State& state, const LinePlace& place,
                    std::string_view reply, Events& events) {
  FaultyLine carrier(model, state, events);
  Carried carried;
  if (carrier.loses(place)) return carried;
  LinePlace at = place;
  for (const char byte : reply) {
    carrier.carry(at, static_cast<std::uint8_t>(byte), carried);
    ++at.offset;
  }
  carried.delay_ms = carrier.delay_ms(place);
  return carried;
}

std::string stray_bytes(const Model& model, State& state, const LinePlace& place, Events& events) {
  return FaultyLine(model, state, events).strays(place);
}

Tick batch_tick(const State& state, std::uint32_t line, Tick from) {
  Tick latest = from;
  for_each_hold(state, FaultKind::kReplyBatched, line, [&](const Fault& fault) {
    const Tick period = fault.period_ms;
    latest = std::max(latest, (from + period - 1) / period * period);
  });
  return latest;
}

Tick xoff_end(const State& state, std::uint32_t line) {
  Tick end = state.tick;
  for_each_hold(state, FaultKind::kXoffStall, line,
                [&](const Fault& fault) { end = std::max(end, fault.end()); });
  return end;
}

}  // namespace xr3
