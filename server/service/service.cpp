#include "server/service/service.hpp"

#include <variant>
#include <vector>

#include "protocol/monitor/heading.hpp"
#include "server/net/wall_clock.hpp"
#include "service/answer.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

// Longer requests are parsed in the worker: a byte may take some 0.1 us.
constexpr std::size_t kMaxParsedAtOnce = std::size_t{64} * 1024;

/// Adds the statistics of a cell and its lines.
void merge(CellCounters& sum, HostedCell& at) {
  sum += at.cell().counters();
  sum.lines_open += at.cell().lines().size();
  sum.robot_port += at.transports().counters();
}

/// Whether a request is about one cell, so that it must have one.
struct ConcernsACell {
  bool operator()(const monitor::Ping&) const { return false; }
  bool operator()(const monitor::Auth&) const { return false; }
  bool operator()(const monitor::Subscribe& sub) const { return is_of_cell(sub.selection.channel); }
  bool operator()(const monitor::Unsubscribe& unsub) const { return is_of_cell(unsub.channel); }
  bool operator()(const monitor::Get& get) const { return is_of_cell(get.selection.channel); }
  bool operator()(const monitor::CallRequest& wanted) const {
    return std::visit(*this, wanted.call);
  }
  bool operator()(const monitor::ListCells&) const { return false; }
  bool operator()(const monitor::Describe&) const { return false; }
  template <class Call>
  bool operator()(const Call&) const {
    return true;
  }
  static bool is_of_cell(Channel channel) { return channel != Channel::kOverview; }
};

}  // namespace

MonitorService::MonitorService(asio::io_context& io, CellRegistry& cells, Worker& worker,
                               const AccessPolicy& policy)
    : cells_(cells),
      worker_(worker),
      overview_(io, cells, [this] { run_lines(); }),
      lag_(io, [this] { return cells_.has_news_to_come(); }),
      sessions_(io, cells, overview_, policy),
      channels_(overview_),
      server_calls_(cells, overview_),
      past_calls_(io, worker, sessions_),
      calls_(cells) {}

// --- Cells.

void MonitorService::changed(HostedCell& cell) {
  measure_loop();
  overview_.changed(cell);
}

void MonitorService::stop() {
  overview_.stop();
  for (const CellPtr& each : cells_.all()) each->hub().stop();
  lag_.stop();
}

CellCounters MonitorService::counters() const {
  CellCounters counters = gone_cells_;
  counters.lines_open = 0;
  for (const CellPtr& each : cells_.all()) merge(counters, *each);
  counters.cells_open = cells_.size();
  counters.cells_total = cells_.total();
  if (count_more_) count_more_(counters);
  sessions_.count(counters);
  counters.loop_lag_ns = lag_.max_at(wall_now());
  return counters;
}

/// The subscribers get what is left of its events; a slow one gets a `lag` and the last event.
void MonitorService::remove_cell(HostedCell& cell) {
  overview_.remove_cell(cell);
  const std::vector<MonitorSession*> sessions = cell.hub().sessions();
  for (MonitorSession* session : sessions) {
    session->client().finish(cell.name());
    cell.hub().remove(*session);
    session->wake();
  }
  merge(gone_cells_, cell);
}

void MonitorService::run_lines() {
  if (!cells_.is_empty()) cells_.all().front()->transports().run_turns();
}

// --- Requests.

monitor::Message MonitorService::refuse(const MonitorSession& session, std::string_view message) {
  if (session.access() == Access::kControl) return nullptr;
  return MonitorSessions::refuse(session, monitor::heading_of(message));
}

asio::awaitable<monitor::RequestReading> MonitorService::read(std::string_view message) {
  const auto parse = [message] { return monitor::read_request(message); };
  if (message.size() <= kMaxParsedAtOnce) co_return parse();
  co_return co_await worker_.run(parse);
}

/// Carries out a request by its type.
struct MonitorService::Dispatch {
  MonitorService& service;
  const CellPtr& at;
  MonitorSession& session;
  monitor::Request& request;

  asio::awaitable<void> operator()(const monitor::Ping&) const {
    session.send(monitor::pong(request.id));
    co_return;
  }
  asio::awaitable<void> operator()(const monitor::Auth& auth) const {
    return service.sessions_.authorize(session, request.id, auth.token);
  }
  asio::awaitable<void> operator()(const monitor::Get& get) const {
    return service.channels_.carry_out(at, session, request.id, get);
  }
  template <class Subscription>
  asio::awaitable<void> operator()(const Subscription& wanted) const {
    service.channels_.carry_out(at, session, request.id, wanted);
    co_return;
  }
  asio::awaitable<void> operator()(const monitor::CallRequest& wanted) const {
    const CallOf of{at, session, request, wanted};
    return std::visit([&](const auto& call) { return carry_out(of, call); }, wanted.call);
  }

  template <class Call>
  asio::awaitable<void> carry_out(CallOf of, const Call& call) const {
    if constexpr (requires { service.server_calls_.carry_out(of, call); })
      return service.server_calls_.carry_out(of, call);
    else if constexpr (requires { service.past_calls_.carry_out(of, call); })
      return service.past_calls_.carry_out(of, call);
    else
      return carry_out_at_cell(of, call);
  }

  template <class Call>
  asio::awaitable<void> carry_out_at_cell(CallOf of, const Call& call) const {
    const std::optional<call::Refused> error = co_await MonitorCalls::wait(of);
    if (error) {
      session.send(service::refused(of.id(), *error));
    } else if (at->is_retired()) {
      session.send(service.sessions_.unknown_cell(session, request));
    } else {
      monitor::Message answer = co_await service.calls_.carry_out(of, call);
      at->after_input();
      session.send(std::move(answer));
    }
  }
};

asio::awaitable<void> MonitorService::carry_out(MonitorSession& session, monitor::Request request) {
  measure_loop();
  if (monitor::Message refusal = MonitorSessions::refuse(session, monitor::heading_of(request))) {
    session.send(std::move(refusal));
    co_return;
  }
  const bool is_auth = std::holds_alternative<monitor::Auth>(request.what);  // sees nothing yet
  const CellPtr at = sessions_.find_cell(session, request);
  const bool needs_cell = request.cell || std::visit(ConcernsACell{}, request.what);
  if (!at && !is_auth && needs_cell) {
    session.send(sessions_.unknown_cell(session, request));
    co_return;
  }
  if (at && needs_cell) co_await at->be_back();
  const Dispatch dispatch{*this, at, session, request};
  co_await std::visit(dispatch, request.what);
}

}  // namespace xr3
