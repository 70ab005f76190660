// The messages of the server, each one JSON object on one line without its line end. Text that came
// from a client and is no UTF-8 is mended, so that whatever is sent can be parsed.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor_fields.hpp"
#include "protocol/monitor_request.hpp"
#include "protocol/snapshot_json.hpp"

namespace xr3::monitor {

/// A message's text, shared by everybody to whom it goes.
using Message = std::shared_ptr<const std::string>;

/// JSON on one line; text that is no UTF-8 is mended.
std::string text_of(const Json& json);

/// What the first message tells: `server` is name and version, `cells` the default one first.
struct Greeting {
  std::string server;
  std::vector<std::string> cells;
  const Model& model;
  const Snapshot& snapshot;
  bool may_call = true;  ///< `control`; otherwise `read`
};
Message hello(const Greeting& greeting);

/// The answer to a call that was carried out.
Message result(const RequestId& id, const Json& value);
/// The answer to whatever was not.
Message result(const RequestError& error);
Message pong(const RequestId& id);

/// Where a message of a channel comes from: `seq` counts per cell and channel, for all clients alike.
struct ChannelHead {
  std::string_view cell;
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  Tick tick = 0;
};
/// A message of a channel; `members` are those after the tick, as a JSON object's text.
Message channel_message(Channel channel, const ChannelHead& head, std::string_view members);

/// The same message as the answer to a `get`: with its id, where there is one.
Message with_id(const Message& message, const RequestId& id);

/// The same message with only these of its members, beside those that always come.
Message with_fields(const Message& message, const Fields& fields);

/// So many messages of a channel, from one seq to another, went past a client.
struct Missed {
  std::int64_t count = 0;
  std::int64_t from_seq = 0;
  std::int64_t to_seq = 0;
};
Message lag(std::string_view cell, Channel channel, const Missed& missed);

/// Why a connection ends.
enum class Bye : std::uint8_t {
  kShutdown,
  kNotJson,
  kTooLong,
  kBadToken,
  kFull,
  kIdle,
  kDisconnected,
};
/// The last message of a connection.
Message bye(Bye why);

}  // namespace xr3::monitor
