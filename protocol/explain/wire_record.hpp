// The bytes that a serial line received or sent at one moment, and how they were interpreted. A
// compact value for a ring buffer: it is filled at every read of a line, and explain.hpp converts
// it to text only for subscribers. It holds no images and no messages, and refilling a record
// reuses its memory.
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
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/rhino_endpoint.hpp"
#include "protocol/line/telnet.hpp"

namespace xr3 {

enum class Direction : std::uint8_t { kIn, kOut };

namespace wire {

/// An executed command, and the results that its text needs.
struct Executed {
  Command command;
  std::optional<std::int8_t> counter = {};  ///< Move: the joint's error counter after it
  bool is_on = false;                       ///< a toggle: the new value
  bool has_device = false;  ///< ToggleSimulator: commands go to the device while disabled
  bool operator==(const Executed&) const = default;
};

/// Bytes that were not executed. Consecutive single bytes with the same problem are one item.
struct Ignored {
  Problem problem;
  RawBytes raw;
  std::uint32_t count = 1;
  bool operator==(const Ignored&) const = default;
};

/// A core Warning that a command raised, without the names of blocks, which would take memory.
struct WarningRaised {
  WarningCode code = WarningCode::kCounterOverflow;
  char label = 0;
  int value = 0;
  int limit = 0;
  bool operator==(const WarningRaised&) const = default;
};

/// A Move without motion: the robot is stalled, or the joint was blocked before and still is.
struct NoMotion {
  char label = 0;
  Stall stall = Stall::kNo;
  Blocked blocked = Blocked::kNo;
  bool operator==(const NoMotion&) const = default;
};

/// The size of a reply with rows of the camera's image; the image itself is not kept.
struct PictureSize {
  int width = 0;
  int height = 0;
  bool operator==(const PictureSize&) const = default;
};

/// An inquiry and its reply.
struct Answered {
  Command command;
  ReplyWith<PictureSize> reply;
  bool operator==(const Answered&) const = default;
};

/// A command that goes to the physical controller instead of the simulated one.
struct ToDevice {
  Command command;
  bool operator==(const ToDevice&) const = default;
};

/// A reply of the physical controller.
struct FromDevice {
  Command inquiry;
  std::uint8_t byte = 0;
  bool operator==(const FromDevice&) const = default;
};

/// Further replies that were sent together; their meaning is not kept.
struct MoreAnswers {
  std::uint32_t count = 0;
  bool operator==(const MoreAnswers&) const = default;
};

using Meaning = std::variant<Executed, Ignored, WarningRaised, MotorBlocked, NoMotion, Answered,
                             ToDevice, FromDevice, MoreAnswers>;

/// The interpretation of the bytes [from, to) of the line's stream in this direction.
struct Item {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  Meaning what;
  bool operator==(const Item&) const = default;
};

}  // namespace wire

/// A run of bytes of a line in one direction.
struct WireRecord {
  Epoch epoch = 0;
  Tick tick = 0;
  LineId line = 0;
  Direction direction = Direction::kIn;
  std::uint64_t offset = 0;  ///< offset of the first byte in the line's stream in this direction
  std::uint64_t bytes = 0;   ///< number of bytes
  std::string shown;         ///< the first kMaxShownIn or kMaxShownOut bytes
  std::optional<TelnetFilter> telnet;  ///< kIn: the line's filter, if any, before the first byte
  std::vector<wire::Item> items;
};

/// Maximum number of bytes kept in a record. A longer read is split into several records, so that
/// every received byte is kept.
inline constexpr std::size_t kMaxShownIn = 64;
inline constexpr std::size_t kMaxShownOut = 256;

/// The time and the line of bytes that were received or sent.
struct WirePlace {
  Epoch epoch = 0;
  Tick tick = 0;
  LineId line = 0;
  std::uint64_t offset = 0;  ///< offset of the first byte in the line's stream in this direction
};

/// Fills `record` for received bytes: at most kMaxShownIn, as the transport delivered them.
/// `before` is the line's telnet filter before these bytes, or nullopt if it has none. `exchanges`
/// are those that the bytes completed, and `machine` is in the state after them, at the same tick.
/// `has_device`: a physical controller is behind the lines.
void fill_in(WireRecord& record, const WirePlace& place, std::string_view bytes,
             const std::optional<TelnetFilter>& before, const std::vector<Exchange>& exchanges,
             const Simulation& machine, bool has_device = false);

/// Fills `record` for bytes sent: any number, as passed to the transport. They are `replies`, in
/// order, and telnet bytes.
void fill_out(WireRecord& record, const WirePlace& place, std::string_view bytes,
              const std::vector<wire::Item>& replies);

/// The reply of an exchange, without its image. Precondition: a command with a reply.
wire::Answered answer_of(const Exchange& exchange);

}  // namespace xr3
