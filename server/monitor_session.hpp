// One connection of the monitor port: finds out what it speaks, then serves JSON lines, or answers
// one HTTP request. Ends with its connection; a failure in it ends nothing else.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/monitor_client.hpp"
#include "protocol/monitor_lines.hpp"
#include "protocol/monitor_opening.hpp"
#include "server/asio.hpp"
#include "server/monitor_service.hpp"
#include "server/monitor_socket.hpp"

namespace xr3 {

class MonitorSession;

/// What all sessions of the port share. It outlives them while they run.
struct MonitorContext {
  MonitorService service;
  std::function<bool()> is_ready;     ///< what /readyz tells
  std::function<void()> tls_refused;  ///< a client spoke TLS
  std::function<void(const std::shared_ptr<MonitorSession>&)>
      ended;  ///< the session may be dropped
};

class MonitorSession : public std::enable_shared_from_this<MonitorSession> {
 public:
  MonitorSession(tcp::socket socket, MonitorContext& context);

  /// Runs until the connection ends.
  void start();

  /// Takes no further request, says `bye` and ends.
  void finish();

  /// Ends the connection now.
  void abort();

 private:
  asio::awaitable<void> run();
  asio::awaitable<std::string> open();
  void greet_after_silence();
  void greet();
  asio::awaitable<void> speak(std::string first_bytes);

  asio::awaitable<void> speak_lines(std::string first_bytes);
  asio::awaitable<void> answer_lines();
  asio::awaitable<void> until_there_is_room();
  asio::awaitable<void> until_all_is_written();
  asio::awaitable<void> write_messages();
  std::string next_batch();

  asio::awaitable<void> speak_http(std::string head);

  MonitorContext& context_;
  MonitorSocket socket_;
  monitor::Opening opening_;
  monitor::Lines lines_;
  monitor::Client client_;
  asio::steady_timer silence_;
  asio::steady_timer to_write_;  ///< never expires; cancelled when there is something to write
  asio::steady_timer written_;   ///< never expires; cancelled when something has been written
  bool is_greeted_ = false;
  bool is_answered_ = false;  ///< no further answer will come
  bool is_written_ = false;   ///< nothing more can or need be written
};

}  // namespace xr3
