// Parses a message of a client of the monitor port into a request with its id, or into an error
// with all details. Unknown members are ignored, except in `args`, where they are errors.
// Independent of the cell and the connection.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/units.hpp"
#include "protocol/monitor/call.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3::monitor {

inline constexpr std::size_t kMaxMessageBytes = 256 * 1024;
inline constexpr std::size_t kMaxIdBytes = 64;
/// Maximum integer of the protocol, so that JavaScript can represent all of them exactly.
inline constexpr std::int64_t kMaxInteger = (std::int64_t{1} << 53) - 1;
inline constexpr int kMaxWithinMs = 60'000;

/// The id of a request; monostate if it has none or an invalid one.
using RequestId = std::variant<std::monostate, std::int64_t, std::string>;

/// The channels. The first four are latest-wins; `event` and `line` deliver every message;
/// `overview` shows all cells together.
enum class Channel : std::uint8_t { kState, kImage, kDisplay, kModel, kEvent, kLine, kOverview };
inline constexpr std::size_t kChannels = 7;

/// Encoding of an image: per row a text of 0 and 1, or run lengths that begin with zeros.
enum class Encoding : std::uint8_t { kRows, kRle };

/// The part of a channel to send. Clients with equal selections share the bytes of a message.
struct Selection {
  Channel channel = Channel::kState;
  Fields fields;                        ///< top-level members; nullopt for all
  Encoding encoding = Encoding::kRows;  ///< image only
  bool operator==(const Selection&) const = default;
};

struct Ping {};

struct Auth {
  std::string token;
};

/// Frame rate in thousandths of a frame per second, kMinMilliHz...kMaxMilliHz.
using MilliHz = int;
inline constexpr MilliHz kMaxMilliHz = 60'000;
inline constexpr MilliHz kMinMilliHz = 100;
/// The highest rate of `overview`.
inline constexpr MilliHz kMaxOverviewMilliHz = 4'000;

struct Subscribe {
  Selection selection;
  MilliHz max_millihz = 30'000;
  bool on_change = true;
  std::optional<std::int64_t> since;  ///< event and line only: the first seq to send
};

struct Unsubscribe {
  Channel channel = Channel::kState;
};

struct Get {
  Selection selection;
  std::optional<std::int64_t> since;  ///< event and line only; nullopt for the last kMaxRecalled
};
inline constexpr std::int64_t kMaxRecalled = 256;

/// A barrier: the call waits until the line has received this number of bytes since it was opened.
struct After {
  std::uint32_t line = 0;
  std::uint64_t bytes_in = 0;
  int within_ms = 1000;  ///< 0...kMaxWithinMs
};

// Calls that the cell does not execute itself.
struct Send {
  std::string bytes;
};
/// Asks for the motor counts that bring the tool to a place; what is not given stays as it is.
struct FindCounts {
  PointUm tip_um;  ///< in the base frame
  std::optional<double> pitch_deg;
  std::optional<double> roll_deg;
  std::string branch;           ///< any if empty
  std::map<char, Counts> near;  ///< motor counts from which the tool moves, by label; default: now
};
struct ListLines {};
struct ListCells {};
struct ListFaults {};
struct DisconnectLine {
  std::uint32_t line = 0;
};
/// Frees the robot port of its owner (--bind-peer).
struct ReleasePeer {};
struct ReadTranscript {};
struct ReadHistory {};
/// A time of the cell's history.
struct PastTime {
  std::optional<std::int64_t> epoch;  ///< nullopt for the current one
  Tick tick = 0;
};
/// Shows the past to this client, which gets no frames of the present until Live.
struct Look {
  PastTime at;
  std::vector<Selection> selections;  ///< selections of latest-wins channels
};
/// Joints and tool in the past, one state every so many ticks.
struct Trace {
  PastTime from;
  Tick every = 0;  ///< > 0
};
struct Live {};
/// Takes the cell back to a time of its history.
struct Seek {
  PastTime at;
};
/// Opens a new cell that begins with that time.
struct Branch {
  PastTime at;
};
/// The description of a call and its args; nullopt for all calls.
struct Describe {
  std::optional<std::string> fn;
};

struct CallRequest {
  std::string fn;
  std::variant<call::Call, Send, FindCounts, ListLines, ListCells, ListFaults, DisconnectLine,
               ReleasePeer, ReadTranscript, ReadHistory, Look, Trace, Live, Seek, Branch, Describe>
      call;
  std::optional<After> after;  ///< step and run_until only
  Fields fields;               ///< step and run_until only: members of the state in the result
};

struct Request {
  RequestId id;
  std::optional<std::string> cell;  ///< as given, of any size; nullopt for the one of `hello`
  std::variant<Ping, Auth, Subscribe, Unsubscribe, Get, CallRequest> what;
};

struct RequestError;  // request_error.hpp, which needs the whole of JSON

using RequestReading = std::variant<Request, RequestError>;

/// The names of `op` that this version knows, as listed in `hello`.
const std::vector<std::string>& ops();

/// The id in a member `id`; nullopt if it is invalid. A missing member or null means no id.
std::optional<RequestId> id_of(JsonValue value);

/// Parses a message. Never throws.
RequestReading read_request(std::string_view message);

/// The error of a request that names an unknown cell, or names none although the `hello` had none.
/// `known` are the cells that the client may name: at most a few similar ones are in the hint.
RequestError unknown_cell(const Request& request, const std::vector<std::string>& known);

/// Keeps simulated time within kMaxInteger ticks: shortens a run_until to end at the last tick, and
/// returns an error for a step past it.
std::optional<RequestError> limit_ticks(Request& request, Tick now);

}  // namespace xr3::monitor
