// Carries out the requests of monitor sessions on the cells, and queues the answers. All sessions
// share one service, which is independent of their transport (JSON lines or WebSocket).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"
#include "server/cells/registry.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/overview.hpp"
#include "server/monitor_port/session.hpp"
#include "server/monitor_port/wrong_tokens.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/loop_lag.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/wall_clock.hpp"
#include "server/net/worker.hpp"

namespace xr3 {

/// Epoch and tick, the first members of the value of each call.
Json value_now(const Cell& cell);

/// The answer with an error.
monitor::Message refused(const monitor::RequestId& id, const call::Refused& why);
/// The error of a request that names a line that is not open.
call::Refused no_such_line(LineId line);

class MonitorService {
 public:
  /// The references must outlive the service.
  MonitorService(asio::io_context& io, CellRegistry& cells, Worker& worker,
                 const AccessPolicy& policy);

  CellRegistry& cells() { return cells_; }
  Overview& overview() { return overview_; }
  WrongTokens& wrong_tokens() { return wrong_tokens_; }

  // --- Sessions.

  void add(MonitorSession& session) { sessions_.push_back(&session); }
  /// Also closes the session's own lines.
  void remove(MonitorSession& session);
  Access first_access() const;
  /// The first message of a session. Without access it describes only the server, and is sent again
  /// after the token.
  monitor::Message hello(MonitorSession& session);
  /// The names of the cells that the session may see.
  std::vector<std::string> visible_cells(const MonitorSession& session) const;

  /// The answer if the session lacks the access for this request; else nullptr, even if the request
  /// is invalid. Parses only the heading, so that requests without access are cheap.
  static monitor::Message refuse(const MonitorSession& session, std::string_view message);

  /// Parses a message, a long one in the worker. `message` must exist until it resumes.
  asio::awaitable<monitor::RequestReading> read(std::string_view message);

  /// Carries out a request and answers it. Only a call with `after` waits. The session must outlive
  /// the coroutine.
  asio::awaitable<void> carry_out(MonitorSession& session, monitor::Request request);

  /// An input of a cell has acted: shows it in the overview, and measures the event loop.
  void acted(HostedCell& cell);
  /// The server has work to do for a client: measures the event loop.
  void note_work() { lag_.note_work(); }
  /// A cell is about to close: its subscriptions end, and its statistics remain in counters().
  void forget(HostedCell& cell);
  asio::io_context& io() { return io_; }
  Worker& worker() { return worker_; }
  /// For the end of the process: starts no timer any more, except for waiting requests.
  void stop();

  /// From now on, calls that enlarge one of several cells are refused beyond a limit of memory,
  /// which must outlive the service.
  void limit_memory(MemoryLimit& limit) { memory_ = &limit; }
  /// Opens the cells of the call `branch`: a cell that begins with this state of another one, or
  /// the refusal.
  using OpenBranch =
      std::function<std::variant<CellPtr, call::Refused>(HostedCell& of, MachineSnapshotPtr past)>;
  void branch_by(OpenBranch open) { open_branch_ = std::move(open); }

  /// Beyond this number a session gets no further subscription, or line of its own.
  static constexpr std::size_t kMaxSubscriptions = 256;
  static constexpr std::size_t kMaxOwnLines = 64;

  /// `count` adds what neither the cells nor the sessions count.
  void count_more(std::function<void(CellCounters&)> count) { count_more_ = std::move(count); }
  /// The statistics of all cells together, of their lines, the sessions and the event loop.
  CellCounters counters() const;

 private:
  asio::awaitable<void> authorize(MonitorSession& session, monitor::Request request);
  void between();
  static bool may_see(const MonitorSession& session, const HostedCell& cell);
  /// The answer to a request that names a cell that the session does not know.
  monitor::Message unknown_cell(const MonitorSession& session,
                                const monitor::Request& request) const;
  /// The cell of a request; nullptr if the session does not know it.
  CellPtr find_cell(const MonitorSession& session, const monitor::Request& request) const;
  asio::awaitable<void> carry_out_overview(MonitorSession& session, monitor::Request request);
  asio::awaitable<void> list_cells(MonitorSession& session, monitor::Request request);
  void describe(const CellPtr& at, MonitorSession& session, const monitor::Request& request);
  asio::awaitable<void> carry_out_at(CellPtr at, MonitorSession& session, monitor::Request request);
  /// The session's own line of a cell, which a first `send` opens.
  /// nullopt: it has too many of other cells.
  std::optional<LineId> own_line(HostedCell& at, MonitorSession& session);
  bool may_enlarge(const call::Call& call) const;
  /// nullopt: the session has no open line at that cell.
  static std::optional<LineId> open_own_line(const HostedCell& at, MonitorSession& session);
  static void subscribe(HostedCell& at, MonitorSession& session, const monitor::Request& request);
  static void unsubscribe(HostedCell& at, MonitorSession& session, const monitor::Request& request);
  static void show(HostedCell& at, MonitorSession& session, const monitor::Request& request);

  asio::awaitable<void> call(CellPtr at, MonitorSession& session, monitor::Request request);
  struct Moment;
  asio::awaitable<void> call_past(CellPtr at, MonitorSession& session, monitor::Request request);
  asio::awaitable<void> list_history(CellPtr at, MonitorSession& session, monitor::RequestId id);
  asio::awaitable<std::optional<Moment>> make_moment(CellPtr at, MonitorSession& session,
                                                     monitor::Request request,
                                                     std::vector<monitor::Selection> selections);
  void end_look(HostedCell& at, MonitorSession& session, const monitor::RequestId& id);
  monitor::Message open_branch(HostedCell& at, const Moment& moment, const monitor::RequestId& id);
  static asio::awaitable<std::optional<call::Refused>> wait_for(HostedCell& at,
                                                                monitor::After after);
  monitor::Message carry_out_call(HostedCell& at, monitor::Request& request);
  monitor::Message call_cell(HostedCell& at, monitor::Request& request);
  asio::awaitable<monitor::Message> send(HostedCell& at, MonitorSession& session,
                                         const monitor::Request& request);
  /// Applies bytes piece by piece. Returns the number of bytes taken.
  static asio::awaitable<std::size_t> receive(HostedCell& at, LineId line, std::string_view bytes);
  static monitor::Message list_lines(HostedCell& at, const monitor::Request& request);
  static monitor::Message transcript(HostedCell& at, const monitor::Request& request);
  static monitor::Message disconnect(HostedCell& at, const monitor::Request& request);
  static monitor::Message release_peer(HostedCell& at, const monitor::Request& request);
  static monitor::Message done(HostedCell& at, const monitor::Request& request,
                               const call::Done& done);

  asio::io_context& io_;
  CellRegistry& cells_;
  Worker& worker_;
  MemoryLimit* memory_ = nullptr;  ///< none if null
  const AccessPolicy& policy_;
  WrongTokens wrong_tokens_;
  std::vector<MonitorSession*> sessions_;
  /// The statistics of removed sessions, by monitor::Channel, and of closed cells.
  std::array<monitor::ChannelStats, monitor::kChannels> gone_sessions_{};
  CellCounters gone_cells_;
  std::function<void(CellCounters&)> count_more_;
  Overview overview_;
  LoopLag lag_;
  Exclusive making_past_;     ///< a time of a cell's past; meanwhile others who look wait
  Exclusive listing_events_;  ///< for a call `history`; meanwhile other such calls wait
  OpenBranch open_branch_;
};

}  // namespace xr3
