// The sessions of the monitor port: what each of them may see and control, its greeting, and the
// statistics of all.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/monitor/heading.hpp"
#include "protocol/monitor/message.hpp"
#include "server/cells/registry.hpp"
#include "server/net/asio.hpp"
#include "server/service/overview.hpp"
#include "server/service/wrong_tokens.hpp"
#include "server/session/access.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class MonitorSessions {
 public:
  /// The references must outlive it.
  MonitorSessions(asio::io_context& io, CellRegistry& cells, Overview& overview,
                  const AccessPolicy& policy)
      : io_(io), cells_(cells), overview_(overview), policy_(policy), wrong_tokens_(io) {}

  /// Called when a client has shown the token of a cell, with its machine: see machine_of().
  using Opened = std::function<void(const asio::ip::address& machine, const HostedCell& cell)>;
  void when_opened(Opened opened) { opened_ = std::move(opened); }

  void add(MonitorSession& session) { all_.push_back(&session); }
  /// Closes the session's own lines.
  void remove(MonitorSession& session);

  Access first_access() const;
  /// The first message of a session. Without access it describes only the server, and is sent again
  /// after the token.
  monitor::Message hello(MonitorSession& session);
  /// Grants access if the token is right, and answers.
  asio::awaitable<void> authorize(MonitorSession& session, const monitor::RequestId& id,
                                  const std::string& token);
  bool needs_token() const { return policy_.needs_token(); }
  /// Whether a token gives control of a cell, the first one if nullopt; a wrong one is answered
  /// later. Precondition: needs_token().
  asio::awaitable<bool> may_control(const std::optional<std::string>& cell,
                                    const std::string& token);
  WrongTokens& wrong_tokens() { return wrong_tokens_; }

  /// The answer to a request for which the session lacks the access; nullptr if it has it.
  static monitor::Message refuse(const MonitorSession& session, const monitor::Heading& heading);
  static bool may_see(const MonitorSession& session, const HostedCell& cell);
  /// The names of the cells that the session may see.
  std::vector<std::string> visible_cells(const MonitorSession& session) const;
  /// The cell of a request; nullptr if the session does not know it.
  CellPtr find_cell(const MonitorSession& session, const monitor::Request& request) const;
  /// The answer to a request that names a cell that the session does not know.
  monitor::Message unknown_cell(const MonitorSession& session,
                                const monitor::Request& request) const;

  /// Adds the statistics of all sessions, also of those that were removed.
  void count(CellCounters& counters) const;

 private:
  asio::io_context& io_;
  CellRegistry& cells_;
  Overview& overview_;
  const AccessPolicy& policy_;
  WrongTokens wrong_tokens_;
  Opened opened_;  ///< may be empty
  std::vector<MonitorSession*> all_;
  std::array<monitor::ChannelStats, monitor::kChannels> removed_{};  ///< by monitor::Channel
};

}  // namespace xr3
