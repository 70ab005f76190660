// The server's messages, each a JSON object on one line without the line end. Invalid UTF-8, which
// may come from a client, is replaced, so that every message can be parsed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor/fields.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3::monitor {

/// The text of a message, shared by all clients that it is sent to.
using Message = std::shared_ptr<const std::string>;

/// JSON on one line; invalid UTF-8 is replaced.
std::string text_of(const Json& json);

/// The rights of a session: none, read, or read and call. They depend on the token.
enum class Access : std::uint8_t { kNone, kRead, kControl };

/// The time of a cell, and how it passes.
struct CellTime {
  std::int64_t epoch = 0;  ///< see Epoch in cell_event.hpp
  Tick tick = 0;
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};

/// The cell of a client's requests that name none.
struct GreetedCell {
  std::string name;
  const Model& model;
  CellTime now;
};

/// The contents of `hello`. `server` is name and version; `cells` are those that the client may
/// name; `cell` is one of them, or nullopt.
struct Greeting {
  std::string server;
  std::vector<std::string> cells;
  std::optional<GreetedCell> cell;
  Access access = Access::kControl;
};
/// Without access it describes only the server, not the cell.
Message hello(const Greeting& greeting);

/// The `result` of a successful request.
Message result(const RequestId& id, const Json& value);
/// The `result` of a failed or invalid request.
Message result(const RequestError& error);
Message pong(const RequestId& id);

/// The head of a channel's message. `seq` is the sequence number per cell and channel, shared by
/// all clients.
struct ChannelHead {
  std::string_view cell;
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  Tick tick = 0;
};
/// A message of a channel. `members` is the text of a JSON object with the members after `tick`.
Message channel_message(Channel channel, const ChannelHead& head, std::string_view members);

/// A channel's message as the reply to a `get`: with the id, if there is one.
Message with_id(const Message& message, const RequestId& id);

/// A channel's message as a reply that shows the past: with the id and `"past":true`.
Message as_past(const Message& message, const RequestId& id);

/// A channel's message with only the selected members and those that are always included.
Message with_fields(const Message& message, const Fields& fields);

/// `count` messages of a channel between two seqs were not sent to a client.
struct Missed {
  std::int64_t count = 0;
  std::int64_t from_seq = 0;
  std::int64_t to_seq = 0;
};
/// The `lag` that reports missed messages of a channel.
Message lag(std::string_view cell, Channel channel, const Missed& missed);

/// The reason why the server closes a connection.
enum class CloseReason : std::uint8_t {
  kShutdown,
  kNotJson,
  kTooLong,
  kBadToken,
  kFull,
  kIdle,
  kDisconnected,
};
/// The last message of a connection.
Message bye(CloseReason why);

}  // namespace xr3::monitor
