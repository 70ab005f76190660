// One client of the monitor, independent of its transport (JSON lines or WebSocket): requests in,
// messages out. The destructor closes the line that the session has opened.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cell/serial_line.hpp"
#include "protocol/monitor/client.hpp"
#include "server/monitor_port/message_sink.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class MonitorService;

using monitor::Access;

class MonitorSession {
 public:
  /// Sends `hello`. Service and sink must outlive the session; the sink is notified of output.
  MonitorSession(MonitorService& service, MessageSink& sink);
  MonitorSession(const MonitorSession&) = delete;
  MonitorSession& operator=(const MonitorSession&) = delete;
  ~MonitorSession();

  /// Carries out one message and queues the answer. Preconditions: the previous call has finished,
  /// and is_full() is false.
  asio::awaitable<void> handle(std::string_view message);

  /// The next message to send, or nullptr.
  monitor::Message next_output();

  /// The queue is full: no request may be handled until the client has read some answers.
  bool is_full() const { return client_.is_full(); }
  /// The bytes of queued answers and frames.
  std::size_t held_bytes() const { return client_.held_bytes(); }
  /// The last message is queued; once it is sent, the transport closes the connection.
  bool has_ended() const { return client_.has_ended(); }
  /// nullopt unless has_ended().
  std::optional<monitor::CloseReason> close_reason() const { return client_.close_reason(); }
  /// The session has a subscription, so messages can follow without further requests.
  bool follows_anything() const { return client_.follows_anything(); }

  /// Queues `bye`.
  void end(monitor::CloseReason why);
  void end(monitor::LineFault fault);

  // --- For the service and the subscribers.

  monitor::Client& client() { return client_; }
  /// Notifies the transport of output.
  void wake() { sink_.pump(); }
  /// Whether the client has yet to accept bytes.
  bool is_blocked() const { return sink_.is_blocked(); }
  /// Prefetches the memory, at one depth, that serving this session will access.
  void prefetch(Depth depth) const;

  Access access() const { return access_; }
  void grant(Access access) { access_ = access; }
  /// Counts a wrong token; returns how many there were.
  int note_wrong_token() { return ++wrong_tokens_; }

  /// The line opened by its first `send`.
  std::optional<LineId> own_line() const { return own_line_; }
  void set_own_line(LineId line) { own_line_ = line; }

 private:
  MonitorService& service_;
  monitor::Client client_;
  MessageSink& sink_;
  Access access_;
  int wrong_tokens_ = 0;
  std::optional<LineId> own_line_;
};

}  // namespace xr3
