// JSON lines over TCP: a thin shell around a viewer. Lines go in one after the other while the client
// takes its answers; messages go out as long as the connection takes them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "protocol/monitor_lines.hpp"
#include "protocol/monitor_opening.hpp"
#include "server/asio.hpp"
#include "server/monitor_service.hpp"
#include "server/monitor_socket.hpp"
#include "server/viewer.hpp"

namespace xr3 {

class JsonLines : public std::enable_shared_from_this<JsonLines>, private Carrier {
 public:
  /// Says hello. `service` outlives it.
  static std::shared_ptr<JsonLines> greet(std::shared_ptr<MonitorSocket> socket,
                                          MonitorService& service);

  /// Serves what begins with these bytes until the connection ends.
  asio::awaitable<void> run(std::string first_bytes, monitor::Tongue tongue);

  /// Takes no further request, says `bye` and ends.
  void finish();

  /// The client has stopped sending; it may be gone altogether, which only writing can tell.
  bool only_listens() const { return is_answered_; }

  /// Whoever waits looks again: the connection is gone.
  void wake();

  /// The viewer leaves, once run() is done or has never begun.
  void retire() { viewer_.reset(); }

 private:
  JsonLines(std::shared_ptr<MonitorSocket> socket, MonitorService& service);

  asio::awaitable<void> answer_lines();
  asio::awaitable<void> until_there_is_room();
  asio::awaitable<void> until_all_is_written();
  bool is_done() const;

  void pump() override;
  void prefetch(Depth depth) const override;
  bool is_one_and_small() const;
  std::size_t send_copy();
  std::size_t send_gathered();
  void fill();
  void wait_for_room();
  void written(std::size_t count);

  // (What every message touches comes first.)
  std::shared_ptr<MonitorSocket> socket_;
  std::vector<monitor::Message> out_;  ///< being written, each with a line end
  std::size_t written_ = 0;            ///< bytes of the first of them
  std::size_t out_bytes_ = 0;
  bool is_blocked_ = false;  ///< the connection takes nothing at the moment
  bool is_pumping_ = false;
  bool is_answered_ = false;     ///< no further request will come
  asio::steady_timer progress_;  ///< never expires; cancelled when something was written
  std::unique_ptr<Viewer> viewer_;
  monitor::Lines lines_;
};

}  // namespace xr3
