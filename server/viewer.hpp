// One client of the monitor, whatever carries it: JSON lines and WebSocket are thin shells around this.
// Messages go in, messages come out; it closes what it had opened when it is destroyed.
#pragma once

#include <functional>
#include <string_view>

#include "protocol/monitor_client.hpp"
#include "server/asio.hpp"

namespace xr3 {

class MonitorService;

class Viewer {
 public:
  /// Says hello. `wake` is called when there is output; the shell then takes it by next_output(), now
  /// or when its connection is writable. `service` outlives the viewer.
  Viewer(MonitorService& service, std::function<void()> wake);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer();

  /// Carries out one message and puts what it is answered into the lane; the next one may be taken when
  /// that is done, and is_full() does not hold.
  asio::awaitable<void> take(std::string_view message);

  /// The message that is to go out next, or null.
  monitor::Message next_output();

  /// No request may be taken until the client has taken some of its answers.
  bool is_full() const;
  /// The last message has been put into the lane: when it is out, the connection ends.
  bool has_ended() const;
  /// Says bye.
  void end(monitor::Bye why);
};

}  // namespace xr3
