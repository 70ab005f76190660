// The subscribers of the channel `overview`, and the changes that each has yet to receive. At most
// kPerSecond rounds a second examine the cells that have had input or move; all subscribers of
// equal rights share the bytes of a message. The rounds take a tenth of the time at most, and at
// rest none runs.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "protocol/monitor/overview.hpp"
#include "server/cells/registry.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"
#include "server/session/session.hpp"

namespace xr3 {

/// The summary of a cell now, to which it advances the cell.
monitor::CellSummary summary_of(HostedCell& at);

class Overview {
 public:
  static constexpr int kPerSecond = 4;

  /// `run_lines` is called between a few cells or sessions, for work that must not wait.
  Overview(asio::io_context& io, CellRegistry& cells, std::function<void()> run_lines);
  Overview(const Overview&) = delete;
  Overview& operator=(const Overview&) = delete;

  /// Subscribes the session; its first message shows all cells that it may see.
  void add(MonitorSession& session);
  /// No effect unless it was added.
  void remove(MonitorSession& session);
  /// The session may see more cells than before: if it is subscribed, its next message shows all.
  void restart(MonitorSession& session);

  /// To be called after an input of the cell, and for a new one.
  void changed(HostedCell& cell);
  /// The cell closes.
  void remove_cell(const HostedCell& cell);
  void stop();

  /// A message with all cells that the session may see.
  monitor::Message whole(const MonitorSession& session,
                         const std::vector<monitor::CellSummary>& cells) const;
  /// The summaries of all cells, as of moments after this call.
  asio::awaitable<std::vector<monitor::CellSummary>> summaries();

 private:
  /// A cell as the subscribers see it.
  struct Shown {
    monitor::CellSummary summary;
    std::string text;
    std::int64_t version = 0;
  };
  using Cells = std::set<HostedCell*>;

  void begin();
  asio::awaitable<void> run();
  asio::awaitable<void> examine_cells();
  asio::awaitable<void> serve_sessions();
  asio::awaitable<void> pause_if_long(WallNs& since);
  void examine(HostedCell& cell);
  void serve(MonitorSession& session);
  monitor::Message message_for(const MonitorSession& session, std::int64_t since);
  monitor::Message make(std::int64_t since, const MonitorSession* only_granted_of) const;

  asio::io_context& io_;
  CellRegistry& cells_;
  std::function<void()> run_lines_;
  asio::steady_timer timer_;  ///< until the next round; cancelled to begin it at once
  std::vector<MonitorSession*> sessions_;
  std::size_t next_ = 0;  ///< index of the session to be served next
  Cells changed_;         ///< to be examined in the next round
  Cells now_;             ///< to be examined in this round
  std::map<HostedCell*, Shown> shown_;
  std::map<std::int64_t, HostedCell*> by_version_;
  std::deque<std::pair<std::int64_t, std::string>> closed_;  ///< the latest, with their versions
  std::int64_t dropped_version_ =
      0;  ///< the version of the last closed cell that is not in closed_
  std::int64_t version_ = 1;
  std::map<std::int64_t, monitor::Message> made_;  ///< in this round, by the version before
  bool is_behind_ = false;                         ///< a session has yet to be served
  bool is_running_ = false;
  bool is_stopped_ = false;
};

}  // namespace xr3
