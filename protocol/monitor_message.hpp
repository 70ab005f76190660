// The messages of the server, each one JSON object on one line without its line end. Text that came
// from a client and is no UTF-8 is mended, so that whatever is sent can be parsed.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor_request.hpp"
#include "protocol/snapshot_json.hpp"

namespace xr3::monitor {

/// A message's text, shared by everybody to whom it goes.
using Message = std::shared_ptr<const std::string>;

/// What the first message tells: `server` is name and version, `cells` the default one first.
struct Greeting {
  std::string server;
  std::vector<std::string> cells;
  const Model& model;
  const Snapshot& snapshot;
};
Message hello(const Greeting& greeting);

/// The answer to a call that was carried out.
Message result(const RequestId& id, const Json& value);
/// The answer to whatever was not.
Message result(const RequestError& error);
Message pong(const RequestId& id);

/// Which state a `state` message shows: `seq` counts those that differ, for all clients alike.
struct StateHead {
  std::string_view cell;
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  Tick tick = 0;
};
/// `members` as chosen; the id only where there is one.
Message state(const RequestId& id, const StateHead& head, const Json& members);

/// Why a connection ends.
enum class Bye : std::uint8_t { kShutdown, kNotJson, kTooLong, kFull };
/// The last message of a connection.
Message bye(Bye why);

}  // namespace xr3::monitor
