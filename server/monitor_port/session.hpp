// One client of the monitor, independent of its transport (JSON lines or WebSocket): requests in,
// messages out. The destructor closes the line that the session has opened.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cell/serial_line.hpp"
#include "protocol/monitor/client.hpp"
#include "server/monitor_port/message_sink.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class HostedCell;
class MonitorService;
class SubscriberHub;

using monitor::Access;

class MonitorSession {
 public:
  /// Sends `hello`. Service and sink must outlive the session; the sink is notified of output.
  /// `chosen`: the cell of requests that name none; nullopt: the first that the session may see.
  MonitorSession(MonitorService& service, MessageSink& sink,
                 std::optional<std::string> chosen = std::nullopt);
  MonitorSession(const MonitorSession&) = delete;
  MonitorSession& operator=(const MonitorSession&) = delete;
  ~MonitorSession();  // NOLINT(bugprone-exception-escape): as in the definition

  /// Carries out one message and queues the answer. Preconditions: the previous call has finished,
  /// and the client's queue is not full.
  asio::awaitable<void> handle(std::string_view message);

  /// The next message to send, or nullptr.
  monitor::Message next_output();

  /// Queues `bye`.
  void end(monitor::CloseReason why);
  void end(monitor::LineFault fault);

  // --- For the service, the subscribers and the transports.

  monitor::Client& client() { return client_; }
  const monitor::Client& client() const { return client_; }
  void send(monitor::Message message) { client_.send(std::move(message)); }
  /// Notifies the transport of output.
  void wake() { sink_.pump(); }

  /// The access to the server as a whole.
  Access access() const { return access_; }
  void grant(Access access) { access_ = access; }
  /// Grants control of one cell, by its token.
  void grant(const std::string& cell) { granted_.insert(cell); }
  bool is_granted(const std::string& cell) const { return granted_.contains(cell); }
  /// The most that the session may do with any cell.
  Access highest_access() const { return granted_.empty() ? access_ : Access::kControl; }

  const std::optional<std::string>& chosen_cell() const { return chosen_cell_; }
  /// The cell of requests that name none, as in the last `hello`; nullopt: none.
  const std::optional<std::string>& own_cell() const { return own_cell_; }
  void set_own_cell(std::optional<std::string> cell) { own_cell_ = std::move(cell); }

  /// Notes that the session is in a hub. Returns false if it was before.
  bool join(SubscriberHub& hub);
  void leave(SubscriberHub& hub);
  const std::vector<SubscriberHub*>& hubs() const { return hubs_; }

  /// Counts a wrong token; returns how many there were.
  int note_wrong_token() { return ++wrong_tokens_; }

  /// The lines opened by its first `send` to each cell.
  std::map<std::string, LineId>& own_lines() { return own_lines_; }

 private:
  MonitorService& service_;
  monitor::Client client_;
  MessageSink& sink_;
  Access access_;
  int wrong_tokens_ = 0;
  std::set<std::string> granted_;
  std::optional<std::string> chosen_cell_;
  std::optional<std::string> own_cell_;
  std::vector<SubscriberHub*> hubs_;  ///< of the cells that it follows
  std::map<std::string, LineId> own_lines_;
};

}  // namespace xr3
