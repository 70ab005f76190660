// Carries out the requests of monitor sessions on the cell, and queues the answers. All sessions
// share one service, which is independent of their transport (JSON lines or WebSocket).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/frame_maker.hpp"
#include "server/monitor_port/session.hpp"
#include "server/monitor_port/subscribers.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/line_transports.hpp"
#include "server/net/loop_lag.hpp"
#include "server/net/wall_clock.hpp"
#include "server/net/worker.hpp"

namespace xr3 {

class MonitorService {
 public:
  /// `acted` is called after each call. The references must outlive the service.
  MonitorService(asio::io_context& io, Cell& cell, LineTransports& lines,
                 const AccessPolicy& policy, std::function<void()> acted);

  std::vector<std::string> cells() const { return {cell_.name()}; }

  // --- Sessions.

  void add(MonitorSession& session) { subscribers_.add(session); }
  /// Also closes the session's own line.
  void remove(MonitorSession& session);
  Access first_access() const;
  /// The first message of a session. Without access it describes only the server, and is sent again
  /// after the token.
  monitor::Message hello(const MonitorSession& session);

  /// The error if the session lacks the access for this request; else nullopt, even if the request
  /// is invalid. Parses only the heading, so that requests without access are cheap.
  std::optional<monitor::RequestError> refuse(const MonitorSession& session,
                                              std::string_view message) const;

  /// Parses a message, a long one in the worker. `message` must exist until it resumes.
  asio::awaitable<monitor::RequestReading> read(std::string_view message);

  /// Carries out a request and answers it. Only a call with `after` waits. The session must outlive
  /// the coroutine.
  asio::awaitable<void> carry_out(MonitorSession& session, monitor::Request request);

  /// The current frame of the cell; nullopt for an image if there is no camera.
  asio::awaitable<std::optional<monitor::Frame>> current_frame(monitor::Selection selection);

  /// An input of the cell has acted: serves the subscribers, and measures the event loop.
  void acted();
  /// The server has work to do for a client: measures the event loop.
  void note_work() { lag_.note_work(); }
  SubscriberHub& subscribers() { return subscribers_; }
  asio::io_context& io() { return io_; }
  Worker& worker() { return worker_; }
  /// For the end of the process: starts no timer any more, except for waiting requests.
  void stop();

  /// The statistics of the cell, the lines, the sessions and the event loop.
  CellCounters counters() const;

 private:
  using Error = std::optional<monitor::RequestError>;

  asio::awaitable<void> authorize(MonitorSession& session, monitor::Request request);
  void note_wrong_token();
  asio::awaitable<void> subscribe(MonitorSession& session, monitor::Request request);
  void unsubscribe(MonitorSession& session, const monitor::Request& request);
  asio::awaitable<void> show(MonitorSession& session, monitor::Request request);
  monitor::Feed& feed(monitor::Channel channel);

  /// The answer to a call that has taken effect. `make` is pure work on copies.
  struct Answer {
    std::function<monitor::Message()> make;
    bool is_long = false;  ///< to be made in the worker
  };
  static Answer at_once(const monitor::Message& message);
  asio::awaitable<monitor::Message> make_long(Answer answer);

  asio::awaitable<void> call(MonitorSession& session, monitor::Request request);
  asio::awaitable<Error> wait_for(monitor::After after);
  Answer carry_out_call(MonitorSession& session, monitor::Request& request);
  Answer call_cell(monitor::Request& request);
  Answer send(MonitorSession& session, const monitor::Request& request);
  Answer list_lines(const monitor::Request& request);
  Answer transcript(const monitor::Request& request);
  monitor::Message disconnect(const monitor::Request& request);
  Answer done(const monitor::Request& request, const call::Done& done);
  /// Epoch and tick, the first members of the value of each call.
  Json value_now() const;
  Json value_with_faults() const;

  asio::io_context& io_;
  Cell& cell_;
  LineTransports& lines_;
  const AccessPolicy& policy_;
  std::function<void()> acted_;
  FrameMaker frames_;
  std::uint64_t wrong_tokens_ = 0;
  WallNs next_token_log_ = 0;  ///< earliest time of the next message about wrong tokens
  SubscriberHub subscribers_;
  LoopLag lag_;
  Exclusive making_long_;  ///< an answer to a call; meanwhile calls wait
  Worker worker_;
};

}  // namespace xr3
