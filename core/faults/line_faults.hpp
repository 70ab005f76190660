// The effects of faults on the data bytes of a line: of the client between telnet filter and
// parser, of the replies between endpoint and telnet filter. Offsets count these bytes of a line
// and direction from 0. The caller moves the bytes; nothing here knows a line but by its number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// A data byte of a line.
struct LinePlace {
  std::uint32_t line = 0;
  LineSide side = LineSide::kIn;
  std::uint64_t offset = 0;
};

/// What arrives of a byte, or of a whole reply, that a line carries.
struct Carried {
  std::string bytes;
  bool has_parity_error = false;  ///< of a byte of this direction
  bool is_disconnected = false;   ///< the line closes after it
  std::uint32_t delay_ms = 0;     ///< of a reply
};

inline bool has_line_faults(const State& state) { return state.faults.now.on_lines; }

/// Returns what arrives at the parser for a data byte of the client.
Carried carry_input(const Model& model, State& state, const LinePlace& place, std::uint8_t byte,
                    Events& events);

/// Returns what arrives at the client for a reply. `place` is that of its first byte.
Carried carry_reply(const Model& model, State& state, const LinePlace& place,
                    std::string_view reply, Events& events);

/// The stray bytes of one direction on a line that opens now.
std::string stray_bytes(const Model& model, State& state, const LinePlace& place, Events& events);

/// The first tick, at or after `from`, in which the line's replies may leave: batches leave at the
/// multiples of their period.
Tick batch_tick(const State& state, std::uint32_t line, Tick from);

/// The tick at which the line's replies are no longer held back by XOFF, kNoTick if that is not
/// known; the current tick if they are not.
Tick xoff_end(const State& state, std::uint32_t line);

}  // namespace xr3
