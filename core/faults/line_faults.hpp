// The effects of faults on the data bytes of a line: on those of the client between telnet filter
// and parser, on the replies between endpoint and telnet filter. Offsets count these bytes per line
// and direction from 0. The caller moves the bytes; a line is only a number here.
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

/// The result of sending a byte or a reply over a faulty line.
struct Carried {
  std::string bytes;
  bool has_parity_error = false;  ///< a byte has a parity error; for the direction that is returned
  bool is_disconnected = false;   ///< the line closes after it
  std::uint32_t delay_ms = 0;     ///< replies only: delay before the first byte
};

inline bool has_line_faults(const State& state) { return state.faults.now.on_lines; }

/// Applies the faults of a line to a data byte of the client. Returns the bytes for the parser.
Carried carry_input(const Model& model, State& state, const LinePlace& place, std::uint8_t byte,
                    Events& events);

/// Applies the faults of a line to a reply. Returns the bytes for the client. `place` is that of
/// the first byte of the reply.
Carried carry_reply(const Model& model, State& state, const LinePlace& place,
                    std::string_view reply, Events& events);

/// The stray bytes of one direction on a line that opens now.
std::string stray_bytes(const Model& model, State& state, const LinePlace& place, Events& events);

/// The first tick, at or after `from`, in which the line's replies may leave: batches leave at the
/// multiples of their period.
Tick batch_tick(const State& state, std::uint32_t line, Tick from);

/// The tick at which XOFF no longer holds back the line's replies: kNoTick if that is not known,
/// the current tick if XOFF does not hold them.
Tick xoff_end(const State& state, std::uint32_t line);

}  // namespace xr3
