// A monitor session over TCP with JSON lines. Reads requests one at a time, only while the client
// reads its answers; writes messages as fast as the connection accepts them.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/service/open_session.hpp"

namespace xr3 {

class JsonLines : public std::enable_shared_from_this<JsonLines>, private MessageSink {
 public:
  /// Sends `hello`. `service` must outlive the session. `machine`: see machine_of().
  static std::shared_ptr<JsonLines> greet(std::shared_ptr<MonitorSocket> socket,
                                          MonitorService& service,
                                          const asio::ip::address& machine);

  /// Serves the connection until it ends. `first_bytes` have been received already.
  asio::awaitable<void> run(std::string first_bytes, monitor::Protocol protocol);

  /// Accepts no further request, sends `bye` and ends.
  void finish();

  /// The client has shut down its sending side. It may be gone; only a write can detect that.
  bool only_listens() const { return is_answered_; }

  /// The bytes of queued messages and of an incomplete request.
  std::size_t held_bytes() const {
    return out_bytes_ + lines_.size() + (session_ ? session_->client().held_bytes() : 0);
  }

  /// Resumes waiting coroutines after the connection was lost.
  void wake();

  /// Destroys the monitor session. Precondition: the connection is closed.
  void retire() {
    assert(!socket_->is_open());
    session_.reset();
  }

 private:
  explicit JsonLines(std::shared_ptr<MonitorSocket> socket);

  asio::awaitable<void> answer_lines();
  bool is_full() const;
  asio::awaitable<void> until_there_is_room();
  asio::awaitable<void> until_all_is_written();
  bool is_done() const;

  void pump() override;
  std::size_t send_some();
  void fill();
  void wait_for_room();
  void pump_later();
  void pump_again();
  void written(std::size_t count);

  // Members used for every message come first, for cache locality.
  std::shared_ptr<MonitorSocket> socket_;
  std::vector<monitor::Message> out_;  ///< being written, each with a line end
  std::size_t written_ = 0;            ///< bytes of the first message already written
  std::size_t out_bytes_ = 0;
  bool is_blocked_ = false;  ///< until the connection is writable or its next turn comes
  bool is_pumping_ = false;
  bool is_answered_ = false;     ///< no further request will be handled
  asio::steady_timer progress_;  ///< never expires; cancelled to resume waiting coroutines
  std::unique_ptr<OpenSession> session_;
  monitor::LineSplitter lines_;
};

}  // namespace xr3
