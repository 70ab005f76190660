// One client of the monitor, independent of its transport (JSON lines or WebSocket): its access,
// its subscriptions, its own lines, and its queue of messages.
//
// The flow through the folder: a transport of server/monitor_port is the MessageSink
// (message_sink.hpp) of a session. AccessPolicy (access.hpp) holds the token of the server, by
// which a session gets its access; a session may also control single cells. Answers go to the
// session's monitor::Client (protocol/monitor), a bounded queue. Each cell has a SubscriberHub
// (subscribers.hpp) with the sessions that follow it: after a change the hub offers each of them
// the current frame, and a client that reads slower than frames are made gets only the last one.
// wake() notifies the transport, which then takes one message after the other by next_output().
// Requests are carried out in server/service, above the cells, which need only this folder.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cell/line/serial_line.hpp"
#include "protocol/monitor/client.hpp"
#include "server/net/asio.hpp"
#include "server/session/message_sink.hpp"

namespace xr3 {

class SubscriberHub;

using monitor::Access;

class MonitorSession {
 public:
  /// The sink must outlive the session; it is notified of output. `machine`: of the client.
  /// `chosen`: the cell of requests that name none; nullopt for the first that the session may see.
  MonitorSession(MessageSink& sink, const asio::ip::address& machine, Access access,
                 std::optional<std::string> chosen)
      : sink_(sink), machine_(machine), access_(access), chosen_cell_(std::move(chosen)) {}
  MonitorSession(const MonitorSession&) = delete;
  MonitorSession& operator=(const MonitorSession&) = delete;

  /// The next message to send; nullptr if there is none.
  monitor::Message next_output();

  /// Queues `bye`.
  void end(monitor::CloseReason why);
  void end(monitor::LineFault fault);

  monitor::Client& client() { return client_; }
  const monitor::Client& client() const { return client_; }
  void send(monitor::Message message) { client_.send(std::move(message)); }
  /// Notifies the transport of output.
  void wake() { sink_.pump(); }

  /// See machine_of().
  const asio::ip::address& machine() const { return machine_; }

  /// The access to the server as a whole.
  Access access() const { return access_; }
  void grant(Access access) { access_ = access; }
  /// Grants control of one cell, by its token.
  void grant(const std::string& cell) { granted_.insert(cell); }
  bool is_granted(const std::string& cell) const { return granted_.contains(cell); }
  /// The most that the session may do with any cell.
  Access highest_access() const { return granted_.empty() ? access_ : Access::kControl; }

  const std::optional<std::string>& chosen_cell() const { return chosen_cell_; }
  /// The cell of requests that name none, as in the last `hello`; nullopt if there is none.
  const std::optional<std::string>& own_cell() const { return own_cell_; }
  void set_own_cell(std::optional<std::string> cell) { own_cell_ = std::move(cell); }

  /// Adds a hub to those that follow the session. Returns false if it was there before.
  bool join(SubscriberHub& hub);
  void leave(SubscriberHub& hub);
  const std::vector<SubscriberHub*>& hubs() const { return hubs_; }

  /// Counts a wrong token; returns how many there were.
  int note_wrong_token() { return ++wrong_tokens_; }

  /// The lines opened by its first `send` to each cell.
  std::map<std::string, LineId>& own_lines() { return own_lines_; }

 protected:
  ~MonitorSession() = default;

 private:
  monitor::Client client_;
  MessageSink& sink_;
  asio::ip::address machine_;
  Access access_;
  int wrong_tokens_ = 0;
  std::set<std::string> granted_;
  std::optional<std::string> chosen_cell_;
  std::optional<std::string> own_cell_;
  std::vector<SubscriberHub*> hubs_;  ///< hubs of the cells that it follows
  std::map<std::string, LineId> own_lines_;
};

}  // namespace xr3
