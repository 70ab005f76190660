#include "server/service/sessions.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cassert>
#include <nlohmann/json.hpp>

#include "cell/failure.hpp"
#include "server/net/wall_clock.hpp"
#include "server/service/calls.hpp"
#include "service/answer.hpp"

namespace xr3 {
namespace {

constexpr int kMaxWrongTokens = 5;

using AllChannelStats = std::array<monitor::ChannelStats, monitor::kChannels>;

void merge(AllChannelStats& sum, const AllChannelStats& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].sent += more[i].sent;
    sum[i].overwritten += more[i].overwritten;
  }
}

/// The cell that the session has chosen, or else the first; nullopt if it may not see that cell.
std::optional<std::string> own_cell_of(const MonitorSession& session,
                                       const std::vector<std::string>& visible) {
  const auto own =
      session.chosen_cell() ? std::ranges::find(visible, *session.chosen_cell()) : visible.begin();
  return own == visible.end() ? std::nullopt : std::optional(*own);
}

}  // namespace

// --- Coming and going.

Access MonitorSessions::first_access() const {
  if (!policy_.needs_token()) return Access::kControl;
  return policy_.is_private() ? Access::kNone : Access::kRead;
}

void MonitorSessions::remove(MonitorSession& session) {
  std::erase(all_, &session);
  overview_.remove(session);
  for (const CellPtr& each : cells_.all())
    if (std::ranges::find(session.hubs(), &each->hub()) != session.hubs().end())
      overview_.changed(*each);
  while (!session.hubs().empty()) session.hubs().back()->remove(session);
  merge(removed_, session.client().channel_stats());
  for (const auto& [name, line] : session.own_lines()) {
    const CellPtr at = cells_.find(name);
    if (!at) continue;
    try {
      at->cell().apply(LineClosed{line, LineCloseReason::kClientClosed}, wall_now());
      at->after_input();
    } catch (const FatalFailure& failure) {  // must not leave a destructor
      asio::post(io_, [failure] { throw failure; });
    }
  }
}

monitor::Message MonitorSessions::hello(MonitorSession& session) {
  monitor::Greeting greeting{
      "xr3 " XR3_VERSION, visible_cells(session), {}, session.highest_access()};
  session.set_own_cell(own_cell_of(session, greeting.cells));
  if (!session.own_cell()) return monitor::hello(greeting);
  Cell& cell = cells_.find(*session.own_cell())->cell();
  cell.catch_up(wall_now());
  const monitor::CellTime now{cell.epoch(), cell.state().tick, cell.clock().mode(),
                              cell.clock().rate()};
  greeting.cell.emplace(monitor::GreetedCell{cell.name(), cell.model(), now});
  return monitor::hello(greeting);
}

asio::awaitable<void> MonitorSessions::authorize(MonitorSession& session,
                                                 const monitor::RequestId& id,
                                                 const std::string& token) {
  if (!policy_.needs_token() || policy_.is_right(token)) {
    const bool had_no_access = session.access() == Access::kNone;
    session.grant(Access::kControl);
    session.send(monitor::result(id, {{"access", "control"}}));
    if (had_no_access) session.send(hello(session));
    if (had_no_access) overview_.restart(session);
    co_return;
  }
  if (const CellPtr cell = cells_.find_by_token(token)) {
    session.grant(cell->name());
    if (opened_) opened_(session.machine(), *cell);
    session.send(monitor::result(id, {{"access", "control"}, {"cell", cell->name()}}));
    if (session.access() == Access::kNone) session.send(hello(session));
    overview_.restart(session);
    co_return;
  }
  co_await wrong_tokens_.delay();
  session.send(service::refused(
      id, {"bad_token", "this is not the token", "five wrong ones end the connection"}));
  if (session.note_wrong_token() >= kMaxWrongTokens) session.end(monitor::CloseReason::kBadToken);
}

asio::awaitable<bool> MonitorSessions::may_control(const std::optional<std::string>& cell,
                                                   const std::string& token) {
  assert(needs_token());
  if (policy_.is_right(token)) co_return true;
  const CellPtr own = cells_.find_by_token(token);
  if (own && cell == own->name()) co_return true;
  co_await wrong_tokens_.delay();
  co_return false;
}

void MonitorSessions::count(CellCounters& counters) const {
  counters.monitor_sessions = all_.size();
  counters.wrong_tokens = wrong_tokens_.count();
  AllChannelStats stats = removed_;
  for (MonitorSession* session : all_) merge(stats, session->client().channel_stats());
  for (std::size_t i = 0; i < stats.size(); ++i)
    counters.channels.at(i) = {stats[i].sent, stats[i].overwritten};
}

// --- Access.

monitor::Message MonitorSessions::refuse(const MonitorSession& session,
                                         const monitor::Heading& heading) {
  if (session.highest_access() == Access::kControl) return nullptr;
  const bool reads = heading.op == "sub" || heading.op == "get";
  std::string what;
  if (heading.op == "call") what = heading.fn.empty() ? "a call" : "the call " + heading.fn;
  if (reads && session.access() == Access::kNone) what = "reading this server";
  if (what.empty()) return nullptr;
  return service::refused(heading.id, {"token_required", what + " needs the token",
                                       R"(send {"op":"auth","token":"..."} first)"});
}

bool MonitorSessions::may_see(const MonitorSession& session, const HostedCell& cell) {
  return session.access() != Access::kNone || session.is_granted(cell.name());
}

std::vector<std::string> MonitorSessions::visible_cells(const MonitorSession& session) const {
  std::vector<std::string> names;
  for (const CellPtr& each : cells_.all())
    if (may_see(session, *each)) names.push_back(each->name());
  return names;
}

CellPtr MonitorSessions::find_cell(const MonitorSession& session,
                                   const monitor::Request& request) const {
  const std::optional<std::string>& name = request.cell ? request.cell : session.own_cell();
  const CellPtr at = name ? cells_.find(*name) : nullptr;
  return at && may_see(session, *at) ? at : nullptr;
}

monitor::Message MonitorSessions::unknown_cell(const MonitorSession& session,
                                               const monitor::Request& request) const {
  return monitor::result(monitor::unknown_cell(request, visible_cells(session)));
}

}  // namespace xr3
