// Interface of the sessions that a WebSocket carries: requests in, messages out. Independent of the
// connection.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/message.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

/// One message of a WebSocket: `head`, then `text`, which many clients may share.
struct WebsocketMessage {
  enum class Type : std::uint8_t { kText, kBinary };

  Type type = Type::kText;
  std::string head = {};
  monitor::Message text = nullptr;  ///< may be null

  std::size_t size() const { return head.size() + (text ? text->size() : 0); }
};

class WebsocketSession {
 public:
  virtual ~WebsocketSession() = default;

  /// Handles one text message at a time, and queues its answer.
  virtual asio::awaitable<void> handle(std::string_view message) = 0;

  /// The next message to send; nullopt if there is none.
  virtual std::optional<WebsocketMessage> next_output() = 0;

  /// Whether no message may be handled until the client has read some answers.
  virtual bool is_full() const = 0;
  virtual std::size_t held_bytes() const = 0;

  /// Ends the session after the messages that are queued.
  virtual void end(monitor::CloseReason why) = 0;
  /// The reason of the end; nullopt before.
  virtual std::optional<monitor::CloseReason> close_reason() const = 0;
};

}  // namespace xr3
