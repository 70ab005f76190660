// The frames of the Foxglove WebSocket protocol, which the subprotocols foxglove.sdk.v1 and
// foxglove.websocket.v1 share: JSON texts for the description of the server, and binary messages.
// A client subscribes to channels, the topics numbered from 1, with numbers of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "protocol/foxglove/time.hpp"
#include "protocol/foxglove/topics.hpp"
#include "protocol/json/document.hpp"

namespace xr3::foxglove {

inline constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1",
                                                               "foxglove.websocket.v1"};

/// Maximum bytes of a client's message: a subscription to all topics needs 300.
inline constexpr std::size_t kMaxClientBytes = 16 * 1024;

/// The text `serverInfo`: `session` differs between runs of the server.
std::string server_info_text(std::string_view name, std::string_view session);

/// The text `advertise` with all topics.
std::string advertise_text(const Model& model);

enum class StatusLevel : std::uint8_t { kInfo, kWarning, kError };
/// The text `status`: a message for the user.
std::string status_text(StatusLevel level, std::string_view message);

/// The bytes of a `time` message.
std::string time_bytes(Nanoseconds time);

/// The bytes before the JSON of a message for a subscription.
std::string message_head(std::uint32_t subscription, Nanoseconds time);

/// The subscriptions of a client, as its requests have made them.
class Subscriptions {
 public:
  /// The result of a request.
  struct Subscribed {
    std::vector<Topic> added;  ///< topics that are now subscribed to
    std::string complaint;     ///< the first part that was not done, and why; empty if all was
  };
  /// Carries out a text message of the client.
  Subscribed carry_out(std::string_view message);

  /// The number of the client's subscription to a topic; nullopt if there is none.
  std::optional<std::uint32_t> find(Topic topic) const;

 private:
  std::string subscribe(JsonValue wanted, Subscribed& outcome);
  std::string unsubscribe(JsonValue number);

  std::map<Topic, std::uint32_t> numbers_;
};

}  // namespace xr3::foxglove
