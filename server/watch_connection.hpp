// One client's connections to a monitor port, one after the other: each is found, opened and read
// line by line into a WatchModel. It knows no terminal.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "protocol/watch_model.hpp"
#include "server/asio.hpp"
#include "server/monitor_socket.hpp"
#include "server/watch_options.hpp"

namespace xr3 {

class WatchConnection {
 public:
  /// The options and the model must outlive it.
  WatchConnection(asio::io_context& context, const WatchOptions& options, watch::WatchModel& model);

  /// Connects and feeds the model until the connection ends, calling `on_news` after each lot of
  /// messages. Returns why it ended, in words, without a stop.
  asio::awaitable<std::string> run(std::function<void()> on_news);

  /// Sends these bytes behind those before; they are lost where there is no connection.
  void send(const std::string& bytes);
  /// Ends what `run` is doing, whatever it is.
  void close();

 private:
  asio::awaitable<std::string> connect();
  asio::awaitable<void> send_all(std::shared_ptr<MonitorSocket> socket);
  bool take(std::string_view bytes);
  std::string farewell(bool is_greeted) const;
  void close_when_due();
  void ask_for_life();

  asio::io_context& context_;
  const WatchOptions& options_;
  watch::WatchModel& model_;
  tcp::resolver resolver_;
  tcp::socket connecting_;
  asio::steady_timer deadline_;  ///< for the greeting, then for an answer to each ping
  bool is_late_ = false;
  bool has_heard_ = false;                 ///< since the last ping
  std::shared_ptr<MonitorSocket> socket_;  ///< none while there is no connection
  std::string line_;                       ///< the beginning of the next message
  std::string unsent_;
  bool is_sending_ = false;
};

}  // namespace xr3
