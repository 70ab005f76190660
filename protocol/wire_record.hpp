// What went over a serial line at one moment, and what was made of it: a compact value for a ring, made
// at every read of a line and put into words only where somebody looks (see explain.hpp). It keeps
// no picture and no text of its own, and a record that is filled anew reuses its memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/simulation.hpp"
#include "protocol/cell_event.hpp"
#include "protocol/rhino_endpoint.hpp"
#include "protocol/telnet.hpp"

namespace xr3 {

enum class Direction : std::uint8_t { kIn, kOut };

namespace wire {

/// A command that was carried out, and what its words need besides.
struct Obeyed {
  Command command;
  std::optional<std::int8_t> counter;  ///< of a Move: the joint's error counter behind it
  bool is_on = false;                  ///< of a toggle: what it came to
};

/// Bytes that were not obeyed. Single bytes that met the same fate one behind the other are one item.
struct Ignored {
  Problem problem;
  RawBytes raw;
  std::uint32_t count = 1;
};

/// A core Warning that a command raised.
struct Raised {
  WarningCode code = WarningCode::kCounterOverflow;
  char label = 0;
  int value = 0;
  int limit = 0;
};

/// A Move that turns nothing: the robot is stalled, or the joint was blocked before and still is.
struct HeldBack {
  char label = 0;
  Stall stall = Stall::kNo;
  Blocked blocked = Blocked::kNo;
};

/// Rows of the camera's picture, without the picture.
struct PictureSize {
  int width = 0;
  int height = 0;
};

/// An inquiry and what it was answered.
struct Answered {
  Command command;
  std::variant<ErrorMagnitude, SignedError, SwitchState, SwitchBits, PictureSize, PixelValue> reply;
};

/// One thing that was made of the bytes [from, to) of the line's stream in this direction.
struct Item {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  std::variant<Obeyed, Ignored, Raised, MotorBlocked, HeldBack, Answered> what;
};

}  // namespace wire

/// One stretch of bytes of a line in one direction.
struct WireRecord {
  Epoch epoch = 0;
  Tick tick = 0;
  LineId line = 0;
  Direction direction = Direction::kIn;
  std::uint64_t offset = 0;            ///< of the first byte in the line's stream in this direction
  std::uint64_t bytes = 0;             ///< how many there were
  std::string shown;                   ///< the first of them: kMostShownIn or kMostShownOut
  std::optional<TelnetFilter> telnet;  ///< in, where there is one: as it was before the first byte
  std::vector<wire::Item> items;
};

/// Bytes of one record that are kept. A longer read is given as several records, so that every byte that
/// came in is seen.
inline constexpr std::size_t kMostShownIn = 64;
inline constexpr std::size_t kMostShownOut = 256;

/// When and where bytes went.
struct WirePlace {
  Epoch epoch = 0;
  Tick tick = 0;
  LineId line = 0;
  std::uint64_t offset = 0;  ///< of the first byte in the line's stream in this direction
};

/// Makes `record` that of bytes that came in: as the transport brought them, at most kMostShownIn.
/// `before` is the line's telnet filter as it was before them, or nothing on a line that has none;
/// `exchanges` is what they completed, `machine` as it is behind them, at the same tick.
void fill_in(WireRecord& record, const WirePlace& place, std::string_view bytes,
             const std::optional<TelnetFilter>& before, const std::vector<Exchange>& exchanges,
             const Simulation& machine);

/// Makes `record` that of bytes that went out in answer to `exchanges`: as the transport gets them,
/// however many.
void fill_out(WireRecord& record, const WirePlace& place, std::string_view bytes,
              const std::vector<Exchange>& exchanges);

}  // namespace xr3
