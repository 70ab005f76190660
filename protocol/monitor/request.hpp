// One message of a monitor's client, read into a value: what is asked for, with the id to answer
// to, or what is wrong with it, all of it. Unknown members are ignored, but inside `args` they are
// refused. It knows neither the cell nor the connection.
#pragma once

#include <cstdint>
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
/// Lists and objects inside one another, the message itself counted.
inline constexpr int kMaxDepth = 32;
inline constexpr std::size_t kMaxIdBytes = 64;
/// Every integer of the protocol is a number that JavaScript has, too.
inline constexpr std::int64_t kMaxInteger = (std::int64_t{1} << 53) - 1;
inline constexpr int kMaxWithinMs = 60'000;

/// Nothing where a request carries no id, or none that could be read.
using RequestId = std::variant<std::monostate, std::int64_t, std::string>;

/// What a client can look at: the last of each of the first four, every message of the others.
enum class Channel : std::uint8_t { kState, kImage, kDisplay, kModel, kEvent, kLine };
inline constexpr std::size_t kChannels = 6;

/// How an image is written: a text of 0 and 1 a row, or run lengths that begin with zeros.
enum class Encoding : std::uint8_t { kRows, kRle };

/// What of a channel is shown, and how: what is selected alike is the same bytes for everybody.
struct Selection {
  Channel channel = Channel::kState;
  Fields fields;                        ///< top-level members; none: all
  Encoding encoding = Encoding::kRows;  ///< image only
  bool operator==(const Selection&) const = default;
};

struct Ping {};

struct Auth {
  std::string token;
};

/// FrameCache a second of 1/1000, 100...60,000.
using MilliHz = int;
inline constexpr MilliHz kMaxMilliHz = 60'000;
inline constexpr MilliHz kMinMilliHz = 100;

struct Subscribe {
  Selection selection;
  MilliHz max_millihz = 30'000;
  bool on_change = true;
  std::optional<std::int64_t> since;  ///< event and line only: the first seq that is wanted
};

struct Unsubscribe {
  Channel channel = Channel::kState;
};

struct Get {
  Selection selection;
  std::optional<std::int64_t> since;  ///< event and line only; none: the last kMaxRecalled
};
inline constexpr std::int64_t kMaxRecalled = 256;

/// A barrier: the call waits until the line has received so many bytes in all.
struct After {
  std::uint32_t line = 0;
  std::uint64_t bytes_in = 0;
  int within_ms = 1000;  ///< 0...kMaxWithinMs
};

/// Calls that are not the cell's own.
struct Send {
  std::string bytes;
};
struct ListLines {};
struct DisconnectLine {
  std::uint32_t line = 0;
};
/// What calls there are and what they take, as JSON; made when the request is read.
struct Describe {
  Json description;
};

struct CallRequest {
  std::string fn;
  std::variant<call::Call, Send, ListLines, DisconnectLine, Describe> call;
  std::optional<After> after;  ///< step and run_until only
  Fields fields;               ///< step and run_until only: members of the state in the answer
};

struct Request {
  RequestId id;
  std::string cell;
  std::variant<Ping, Auth, Subscribe, Unsubscribe, Get, CallRequest> what;
};

/// One wrong value: where it stands in the message (JSON pointer), null where nothing stands there.
struct Detail {
  std::string pointer;
  Json found;
  std::string allowed;
};

/// Why a request is not carried out. `code` is stable.
struct RequestError {
  RequestId id;
  std::string code;
  std::string message;
  std::string hint;
  std::vector<Detail> details;
};

using RequestReading = std::variant<Request, RequestError>;

/// What there is to ask for in this version, as `hello` lists it.
const std::vector<std::string>& ops();
const std::vector<std::string>& channels();
const std::vector<std::string>& calls();

/// The id that a member `id` is, or nothing where it cannot be one. No member, or null: no id.
std::optional<RequestId> id_of(JsonValue value);

/// Reads one message. `cells`: those that may be named, the default first. Never throws.
RequestReading read_request(std::string_view message, const std::vector<std::string>& cells);

/// Keeps time inside what the protocol can say: a run is cut short at the last tick, a step that
/// would pass it is an error.
std::optional<RequestError> fit(Request& request, Tick now);

/// `"a", "b" or "c"`.
std::string one_of(const std::vector<std::string>& names);

}  // namespace xr3::monitor
