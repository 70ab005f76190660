// The monitor connection of `xr3 watch`: resolves the address, connects, and feeds the messages to
// a WatchModel. Can be run again after a connection has ended. Independent of the terminal.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/options/watch.hpp"
#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "tools/watch/model.hpp"

namespace xr3 {

class WatchConnection {
 public:
  /// The options and the model must outlive it.
  WatchConnection(asio::io_context& context, const WatchOptions& options, watch::WatchModel& model);

  /// Connects and feeds the model until the connection ends; calls `on_news` after each read.
  /// Returns the reason for the end, as text without a full stop.
  asio::awaitable<std::string> run(std::function<void()> on_news);

  /// Queues the bytes for sending; discards them if there is no connection.
  void send(const std::string& bytes);
  /// Ends run() in any phase.
  void close();

 private:
  asio::awaitable<std::string> connect();
  asio::awaitable<void> send_all(std::shared_ptr<MonitorSocket> socket);
  bool feed(std::string_view bytes);
  std::string close_reason(bool is_greeted) const;
  void close_when_due();
  void close_late();
  void ask_for_life();

  asio::io_context& context_;
  const WatchOptions& options_;
  watch::WatchModel& model_;
  tcp::resolver resolver_;
  tcp::socket connecting_;
  asio::steady_timer deadline_;  ///< for `hello`, then for the answer to each ping
  bool is_late_ = false;
  bool has_heard_ = false;                 ///< whether data was received since the last ping
  std::shared_ptr<MonitorSocket> socket_;  ///< nullptr without a connection
  std::string line_;                       ///< the incomplete next message
  std::string unsent_;
  bool is_sending_ = false;
};

}  // namespace xr3
