// Carries out the requests of monitor sessions on the cells, and queues the answers. All sessions
// share one service, which is independent of their transport (JSON lines or WebSocket).
//
// The flow through the folder: a transport gives a message to its OpenSession (open_session.hpp).
// The service refuses it if the session lacks the access, parses it (a long one in the worker), and
// finds its cell. The request then goes by its type, once, to the object that has a function for
// that type: MonitorSessions (sessions.hpp) for tokens, MonitorChannels (channels.hpp) for `sub`,
// `unsub` and `get`, ServerCalls (server_calls.hpp) for calls on the server, PastCalls
// (past_calls.hpp) for those on a cell's past, and MonitorCalls (calls.hpp, line_calls.cpp) for the
// others. What a request does to a cell, and its answer, is in service/, below the server; here it
// waits for what it needs, such as a cell that is absent. The Overview (overview.hpp)
// shows all cells to its subscribers, a few rounds a second, after changed() has marked those that
// had input. The frames of one cell go by its SubscriberHub in server/session.
#pragma once

#include <functional>
#include <string_view>
#include <utility>

#include "cell/counters.hpp"
#include "server/cells/registry.hpp"
#include "server/net/asio.hpp"
#include "server/net/loop_lag.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/worker.hpp"
#include "server/service/calls.hpp"
#include "server/service/channels.hpp"
#include "server/service/overview.hpp"
#include "server/service/past_calls.hpp"
#include "server/service/server_calls.hpp"
#include "server/service/sessions.hpp"
#include "server/session/access.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class MonitorService {
 public:
  /// The references must outlive the service.
  MonitorService(asio::io_context& io, CellRegistry& cells, Worker& worker,
                 const AccessPolicy& policy);

  CellRegistry& cells() { return cells_; }
  Overview& overview() { return overview_; }
  MonitorSessions& sessions() { return sessions_; }
  MonitorCalls& calls() { return calls_; }
  PastCalls& past_calls() { return past_calls_; }
  Worker& worker() { return worker_; }

  /// The answer if the session lacks the access for this request; else nullptr, even if the request
  /// is invalid. Parses only the heading, so that requests without access are cheap.
  static monitor::Message refuse(const MonitorSession& session, std::string_view message);

  /// Parses a message, a long one in the worker. `message` must exist until it resumes.
  asio::awaitable<monitor::RequestReading> read(std::string_view message);

  /// Carries out a request and answers it. Only a call with `after` waits. The session must outlive
  /// the coroutine.
  asio::awaitable<void> carry_out(MonitorSession& session, monitor::Request request);

  /// To be called after an input of a cell: shows it in the overview, and measures the event loop.
  void changed(HostedCell& cell);
  /// Measures the delay of the event loop, which has work to do for a client.
  void measure_loop() { lag_.begin_measurement(); }
  /// A cell is about to close: its subscriptions end, and its statistics remain in counters().
  void remove_cell(HostedCell& cell);
  /// For the end of the process: starts no timer any more, except for waiting requests.
  void stop();

  /// `count` adds what neither the cells nor the sessions count.
  void count_more(std::function<void(CellCounters&)> count) { count_more_ = std::move(count); }
  /// The statistics of all cells together, of their lines, the sessions and the event loop.
  CellCounters counters() const;

 private:
  struct Dispatch;
  void run_lines();

  CellRegistry& cells_;
  Worker& worker_;
  CellCounters gone_cells_;  ///< the statistics of closed cells
  std::function<void(CellCounters&)> count_more_;
  Overview overview_;
  LoopLag lag_;
  MonitorSessions sessions_;
  MonitorChannels channels_;
  ServerCalls server_calls_;
  PastCalls past_calls_;
  MonitorCalls calls_;
};

}  // namespace xr3
