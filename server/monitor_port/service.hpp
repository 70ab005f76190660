// What the monitor's clients ask of the cell, carried out: requests in, messages into their lanes. It
// knows no connection; all sessions, whatever carries them, share one service.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/cell.hpp"
#include "cell/frames.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/session.hpp"
#include "server/monitor_port/subscribers.hpp"
#include "server/net/asio.hpp"
#include "server/robot_port/port.hpp"

namespace xr3 {

class MonitorService {
 public:
  /// `acted` is called after each call. All of them outlive it.
  MonitorService(asio::io_context& io, Cell& cell, RobotPort& robot_port,
                 const AccessPolicy& policy, std::function<void()> acted);

  std::vector<std::string> cells() const { return {cell_.name()}; }

  // --- Sessions.

  void add(MonitorSession& session) { subscribers_.add(session); }
  /// Closes what the session had opened.
  void remove(MonitorSession& session);
  Access first_access() const;
  /// The first message of a connection.
  monitor::Message hello(const MonitorSession& session);

  /// Why the session may not ask for this, whatever else may be wrong with it. Only the heading of the message
  /// is looked at: what comes from who may not ask costs nothing.
  std::optional<monitor::RequestError> refuse(const MonitorSession& session,
                                              std::string_view message) const;

  /// Carries out a request and answers it. A call with `after` waits; nothing else does. The session
  /// must still be there when it is done.
  asio::awaitable<void> carry_out(MonitorSession& session, monitor::Request request);

  /// A frame of the cell as it is now, or null for an image where there is no camera.
  const monitor::Frame* look(const monitor::Selection& selection);

  SubscriberHub& subscribers() { return subscribers_; }

  /// What cell and sessions have counted.
  CellCounters counters() const;

 private:
  using Error = std::optional<monitor::RequestError>;

  void authorize(MonitorSession& session, const monitor::Request& request,
                 const monitor::Auth& auth);
  void subscribe(MonitorSession& session, const monitor::Request& request);
  void unsubscribe(MonitorSession& session, const monitor::Request& request);
  void show(MonitorSession& session, const monitor::Request& request);
  monitor::Feed& feed(monitor::Channel channel);

  asio::awaitable<void> call(MonitorSession& session, monitor::Request request);
  asio::awaitable<Error> wait_for(monitor::After after);
  monitor::Message call_cell(monitor::Request& request);
  monitor::Message send(MonitorSession& session, const monitor::Request& request);
  monitor::Message list_lines(const monitor::Request& request);
  monitor::Message disconnect(const monitor::Request& request);
  monitor::Message done(const monitor::Request& request, const call::Done& done);
  /// Epoch and tick, which every value begins with.
  Json value_now() const;

  Cell& cell_;
  RobotPort& robot_port_;
  const AccessPolicy& policy_;
  std::function<void()> acted_;
  FrameCache frames_;
  SubscriberHub subscribers_;
};

}  // namespace xr3
