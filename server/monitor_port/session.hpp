// One client of the monitor, whatever carries it: JSON lines and WebSocket are thin shells around this.
// Messages go in, messages come out; what it had opened is closed when it is destroyed.
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

/// What a client may do: look, and with the token, or where none is needed, call.
enum class Access : std::uint8_t { kNone, kRead, kControl };

class MonitorSession {
 public:
  /// Says hello. Both outlive the session; the sink is told when there is output.
  MonitorSession(MonitorService& service, MessageSink& sink);
  MonitorSession(const MonitorSession&) = delete;
  MonitorSession& operator=(const MonitorSession&) = delete;
  ~MonitorSession();

  /// Carries out one message and puts what it is answered into the queue; the next one may be taken when
  /// that is done, and is_full() does not hold.
  asio::awaitable<void> handle(std::string_view message);

  /// The message that is to go out next, or null.
  monitor::Message next_output();

  /// No request may be taken until the client has taken some of its answers.
  bool is_full() const { return client_.is_full(); }
  /// The last message has been put into the queue: when it is out, the connection ends.
  bool has_ended() const { return client_.has_ended(); }
  /// Why; nothing where it has not.
  std::optional<monitor::CloseReason> close_reason() const { return client_.close_reason(); }
  /// It still follows a channel: messages may come although nothing is asked any more.
  bool follows_anything() const { return client_.follows_anything(); }

  /// Says bye.
  void end(monitor::CloseReason why);
  void end(monitor::LineFault fault);

  // --- For the service and the subscribers.

  monitor::Client& client() { return client_; }
  /// There is output.
  void wake() { sink_.pump(); }
  /// It will be served soon: brings what that will touch, at one depth.
  void prefetch(Depth depth) const;

  Access access() const { return access_; }
  void grant(Access access) { access_ = access; }
  /// Counts a wrong token; returns how many there were.
  int note_wrong_token() { return ++wrong_tokens_; }

  /// The line that its first `send` opened.
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
