#include "server/monitor_port/service.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/failure.hpp"
#include "protocol/monitor/heading.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

constexpr int kMaxWrongTokens = 5;
// Longer requests are parsed in the worker: a byte may take some 0.1 us.
constexpr std::size_t kMaxParsedAtOnce = std::size_t{64} * 1024;

using AllChannelStats = std::array<monitor::ChannelStats, monitor::kChannels>;

/// The current frame; nullptr for an image if there is no camera.
const monitor::Frame* current_frame(HostedCell& at, const monitor::Selection& selection) {
  at.cell().catch_up(wall_now());
  return at.frames().frame(selection);
}

bool is_feed(Channel channel) { return channel == Channel::kEvent || channel == Channel::kLine; }

/// The ring of a channel without loss, which keeps its cell.
std::shared_ptr<monitor::Feed> feed_of(HostedCell& at, Channel channel) {
  return at.share(channel == Channel::kEvent ? at.cell().events() : at.cell().wires());
}

void merge(AllChannelStats& sum, const AllChannelStats& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].sent += more[i].sent;
    sum[i].overwritten += more[i].overwritten;
  }
}

/// Adds the statistics of a cell and its lines.
void merge(CellCounters& sum, HostedCell& at) {
  sum += at.cell().counters();
  sum.lines_open += at.cell().lines().size();
  sum.robot_port += at.transports().counters();
}

bool is_overview(const monitor::Request& request) {
  constexpr Channel kOverview = Channel::kOverview;
  if (const auto* sub = std::get_if<monitor::Subscribe>(&request.what))
    return sub->selection.channel == kOverview;
  if (const auto* unsub = std::get_if<monitor::Unsubscribe>(&request.what))
    return unsub->channel == kOverview;
  const auto* get = std::get_if<monitor::Get>(&request.what);
  return get != nullptr && get->selection.channel == kOverview;
}

template <class Call>
bool is_call(const monitor::Request& request) {
  const auto* wanted = std::get_if<monitor::CallRequest>(&request.what);
  return wanted != nullptr && std::holds_alternative<Call>(wanted->call);
}

/// Whether a request is about one cell, so that it must have one.
bool concerns_a_cell(const monitor::Request& request) {
  return !std::holds_alternative<monitor::Ping>(request.what) &&
         !std::holds_alternative<monitor::Auth>(request.what) && !is_overview(request) &&
         !is_call<monitor::ListCells>(request) && !is_call<monitor::Describe>(request);
}

monitor::Message no_camera(const monitor::RequestId& id) {
  return refused(id, {"no_camera", "this workcell has no camera",
                      "give the workcell file a camera, or replace it by the call workcell"});
}

/// The answer to a request for which the session lacks the access; nullptr if it has it.
monitor::Message refuse_access(const MonitorSession& session, const monitor::Heading& heading) {
  if (session.highest_access() == Access::kControl) return nullptr;
  const bool reads = heading.op == "sub" || heading.op == "get";
  std::string what;
  if (heading.op == "call") what = heading.fn.empty() ? "a call" : "the call " + heading.fn;
  if (reads && session.access() == Access::kNone) what = "reading this server";
  if (what.empty()) return nullptr;
  return refused(heading.id, {"token_required", what + " needs the token",
                              R"(send {"op":"auth","token":"..."} first)"});
}

/// The `result` of a `sub`: the parameters in effect.
Json terms(const std::string& cell, const monitor::Subscribe& wanted, std::int64_t since) {
  const Channel channel = wanted.selection.channel;
  Json value = {{"cell", cell}, {"channel", monitor::name_of(channel)}};
  if (is_feed(channel)) {
    value["since"] = since;
  } else {
    value["max_hz"] = wanted.max_millihz / 1000.0;
    value["on_change"] = wanted.on_change;
  }
  value["fields"] = wanted.selection.fields ? Json(*wanted.selection.fields) : Json();
  if (channel == Channel::kImage)
    value["encoding"] = wanted.selection.encoding == monitor::Encoding::kRle ? "rle" : "rows";
  return value;
}

/// The cell that the session has chosen, or else the first; nullopt if it may not see that cell.
std::optional<std::string> own_cell_of(const MonitorSession& session,
                                       const std::vector<std::string>& visible) {
  const auto own =
      session.chosen_cell() ? std::ranges::find(visible, *session.chosen_cell()) : visible.begin();
  return own == visible.end() ? std::nullopt : std::optional(*own);
}

}  // namespace

MonitorService::MonitorService(asio::io_context& io, CellRegistry& cells, Worker& worker,
                               const AccessPolicy& policy)
    : io_(io),
      cells_(cells),
      worker_(worker),
      policy_(policy),
      wrong_tokens_(io),
      overview_(io, cells, [this] { between(); }),
      lag_(io, [this] { return cells_.has_news_to_come(); }),
      making_past_(io),
      listing_events_(io) {}

// --- Sessions.

Access MonitorService::first_access() const {
  if (!policy_.needs_token()) return Access::kControl;
  return policy_.is_private() ? Access::kNone : Access::kRead;
}

void MonitorService::remove(MonitorSession& session) {
  std::erase(sessions_, &session);
  overview_.remove(session);
  while (!session.hubs().empty()) session.hubs().back()->remove(session);
  merge(gone_sessions_, session.client().channel_stats());
  for (const auto& [name, line] : session.own_lines()) {
    const CellPtr at = cells_.find(name);
    if (!at) continue;
    try {
      at->cell().apply(LineClosed{line, LineCloseReason::kClientClosed}, wall_now());
      at->acted();
    } catch (const VitalFailure& failure) {  // must not leave a destructor
      asio::post(io_, [failure] { throw failure; });
    }
  }
}

std::vector<std::string> MonitorService::visible_cells(const MonitorSession& session) const {
  std::vector<std::string> names;
  for (const CellPtr& each : cells_.all())
    if (may_see(session, *each)) names.push_back(each->name());
  return names;
}

monitor::Message MonitorService::hello(MonitorSession& session) {
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

void MonitorService::acted(HostedCell& cell) {
  note_work();
  overview_.acted(cell);
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
  counters.monitor_sessions = sessions_.size();
  counters.wrong_tokens = wrong_tokens_.count();
  counters.loop_lag_ns = lag_.max_at(wall_now());
  AllChannelStats channel_stats = gone_sessions_;
  for (MonitorSession* session : sessions_) merge(channel_stats, session->client().channel_stats());
  for (std::size_t i = 0; i < channel_stats.size(); ++i)
    counters.channels.at(i) = {channel_stats[i].sent, channel_stats[i].overwritten};
  return counters;
}

// --- Cells.

/// The subscribers get what is left of its events; a slow one gets a `lag` and the last event.
void MonitorService::forget(HostedCell& cell) {
  overview_.forget(cell);
  const std::vector<MonitorSession*> sessions = cell.hub().sessions();
  for (MonitorSession* session : sessions) {
    session->client().finish(cell.name());
    cell.hub().remove(*session);
    session->wake();
  }
  merge(gone_cells_, cell);
}

void MonitorService::between() {
  if (!cells_.is_empty()) cells_.all().front()->transports().run_turns();
}

bool MonitorService::may_see(const MonitorSession& session, const HostedCell& cell) {
  return session.access() != Access::kNone || session.is_granted(cell.name());
}

CellPtr MonitorService::find_cell(const MonitorSession& session,
                                  const monitor::Request& request) const {
  const std::optional<std::string>& name = request.cell ? request.cell : session.own_cell();
  const CellPtr at = name ? cells_.find(*name) : nullptr;
  return at && may_see(session, *at) ? at : nullptr;
}

monitor::Message MonitorService::unknown_cell(const MonitorSession& session,
                                              const monitor::Request& request) const {
  return monitor::result(monitor::unknown_cell(request, visible_cells(session)));
}

// --- Requests.

monitor::Message MonitorService::refuse(const MonitorSession& session, std::string_view message) {
  if (session.access() == Access::kControl) return nullptr;
  return refuse_access(session, monitor::heading_of(message));
}

asio::awaitable<monitor::RequestReading> MonitorService::read(std::string_view message) {
  const auto parse = [message] { return monitor::read_request(message); };
  if (message.size() <= kMaxParsedAtOnce) co_return parse();
  co_return co_await worker_.run(parse);
}

asio::awaitable<void> MonitorService::carry_out(MonitorSession& session, monitor::Request request) {
  note_work();
  if (monitor::Message refusal = refuse_access(session, monitor::heading_of(request))) {
    session.send(std::move(refusal));
    co_return;
  }
  const bool is_auth = std::holds_alternative<monitor::Auth>(request.what);  // sees nothing yet
  CellPtr at = find_cell(session, request);
  if (!at && !is_auth && (request.cell || concerns_a_cell(request))) {
    session.send(unknown_cell(session, request));
  } else if (std::holds_alternative<monitor::Ping>(request.what)) {
    session.send(monitor::pong(request.id));
  } else if (is_auth) {
    co_await authorize(session, std::move(request));
  } else if (is_overview(request)) {
    co_await carry_out_overview(session, std::move(request));
  } else if (is_call<monitor::ListCells>(request)) {
    co_await list_cells(session, std::move(request));
  } else if (is_call<monitor::Describe>(request)) {
    describe(at, session, request);
  } else {
    co_await carry_out_at(std::move(at), session, std::move(request));
  }
}

/// Carries out a request that concerns a cell, which `at` keeps meanwhile.
asio::awaitable<void> MonitorService::carry_out_at(CellPtr at, MonitorSession& session,
                                                   monitor::Request request) {
  if (std::holds_alternative<monitor::Subscribe>(request.what)) {
    subscribe(*at, session, request);
  } else if (std::holds_alternative<monitor::Unsubscribe>(request.what)) {
    unsubscribe(*at, session, request);
  } else if (std::holds_alternative<monitor::Get>(request.what)) {
    show(*at, session, request);
  } else {
    co_await call(std::move(at), session, std::move(request));
  }
}

asio::awaitable<void> MonitorService::authorize(MonitorSession& session, monitor::Request request) {
  if (!policy_.needs_token() || policy_.is_right(std::get<monitor::Auth>(request.what).token)) {
    const bool had_no_access = session.access() == Access::kNone;
    session.grant(Access::kControl);
    session.send(monitor::result(request.id, {{"access", "control"}}));
    if (had_no_access) session.send(hello(session));
    if (had_no_access) overview_.restart(session);
    co_return;
  }
  if (const CellPtr cell = cells_.find_by_token(std::get<monitor::Auth>(request.what).token)) {
    session.grant(cell->name());
    session.send(monitor::result(request.id, {{"access", "control"}, {"cell", cell->name()}}));
    if (session.access() == Access::kNone) session.send(hello(session));
    overview_.restart(session);
    co_return;
  }
  co_await wrong_tokens_.delay();
  session.send(refused(
      request.id, {"bad_token", "this is not the token", "five wrong ones end the connection"}));
  if (session.note_wrong_token() >= kMaxWrongTokens) session.end(monitor::CloseReason::kBadToken);
}

// --- Channels.

void MonitorService::subscribe(HostedCell& at, MonitorSession& session,
                               const monitor::Request& request) {
  const auto& wanted = std::get<monitor::Subscribe>(request.what);
  const Channel channel = wanted.selection.channel;
  monitor::Client& client = session.client();
  if (!client.follows(at.name(), channel) && client.subscriptions() >= kMaxSubscriptions) {
    return session.send(
        refused(request.id,
                {"limit", "this client has 256 subscriptions",
                 "end one by unsub, or subscribe to the channel overview, which shows all cells"}));
  }
  if (is_feed(channel)) {
    at.cell().catch_up(wall_now());
    const std::shared_ptr<monitor::Feed> feed = feed_of(at, channel);
    const std::int64_t next = feed->next();
    const std::int64_t since = std::clamp<std::int64_t>(wanted.since.value_or(next), 1, next);
    session.send(monitor::result(request.id, terms(at.name(), wanted, since)));
    client.follow_feed(at.name(), wanted, feed);
  } else {
    const monitor::Frame* frame = current_frame(at, wanted.selection);
    if (frame == nullptr) return session.send(no_camera(request.id));
    session.send(monitor::result(request.id, terms(at.name(), wanted, 0)));
    client.follow_frames(at.name(), wanted).offer(*frame, at.hub().now());
  }
  at.hub().add(session);
  at.hub().acted();
}

void MonitorService::unsubscribe(HostedCell& at, MonitorSession& session,
                                 const monitor::Request& request) {
  const Channel channel = std::get<monitor::Unsubscribe>(request.what).channel;
  session.client().unfollow(at.name(), channel);
  if (!session.client().follows(at.name())) at.hub().remove(session);
  session.send(monitor::result(request.id, Json::object()));
}

void MonitorService::show(HostedCell& at, MonitorSession& session,
                          const monitor::Request& request) {
  const auto& get = std::get<monitor::Get>(request.what);
  if (is_feed(get.selection.channel)) {
    at.cell().catch_up(wall_now());
    session.client().replay(feed_of(at, get.selection.channel), at.name(), get, request.id);
    return session.send(monitor::result(request.id, Json::object()));
  }
  const monitor::Frame* frame = current_frame(at, get.selection);
  session.send(frame != nullptr ? monitor::with_id(frame->message, request.id)
                                : no_camera(request.id));
}

}  // namespace xr3
