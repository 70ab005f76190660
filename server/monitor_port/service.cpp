#include "server/monitor_port/service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/failure.hpp"
#include "protocol/monitor/heading.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

constexpr int kMaxWrongTokens = 5;
constexpr std::chrono::milliseconds kWrongTokenDelay{200};
// Parsing takes some 0.2 us a byte.
constexpr std::size_t kMaxParsedAtOnce = 4096;
constexpr WallNs kTokenLogEvery = 1'000'000'000;

bool is_feed(Channel channel) { return channel == Channel::kEvent || channel == Channel::kLine; }

monitor::RequestError no_camera(const monitor::RequestId& id) {
  return {id,
          "no_camera",
          "this workcell has no camera",
          "give the workcell file a camera, or replace it by the call workcell",
          {}};
}

monitor::RequestError token_required(const monitor::RequestId& id, const std::string& what) {
  return {id,
          "token_required",
          what + " needs the token",
          R"(send {"op":"auth","token":"..."} first)",
          {}};
}

std::optional<monitor::RequestError> check_access(const MonitorSession& session,
                                                  const monitor::Heading& heading) {
  if (session.access() == Access::kControl) return std::nullopt;
  if (heading.op == "call")
    return token_required(heading.id, heading.fn.empty() ? "a call" : "the call " + heading.fn);
  const bool reads = heading.op == "sub" || heading.op == "get";
  if (reads && session.access() == Access::kNone)
    return token_required(heading.id, "reading this server");
  return std::nullopt;
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

}  // namespace

MonitorService::MonitorService(asio::io_context& io, Cell& cell, LineTransports& lines,
                               const AccessPolicy& policy, std::function<void()> acted)
    : io_(io),
      cell_(cell),
      lines_(lines),
      policy_(policy),
      acted_(std::move(acted)),
      frames_(io, cell, worker_),
      subscribers_(io, cell, frames_, [this] { lines_.run_turns(); }),
      lag_(io, [this] { return cell_.has_news_to_come(); }),
      making_long_(io) {}

// --- Sessions.

Access MonitorService::first_access() const {
  if (!policy_.needs_token()) return Access::kControl;
  return policy_.is_private() ? Access::kNone : Access::kRead;
}

void MonitorService::remove(MonitorSession& session) {
  subscribers_.remove(session);
  const std::optional<LineId> line = session.own_line();
  if (!line) return;
  try {
    cell_.apply(LineClosed{*line, LineCloseReason::kClientClosed}, wall_now());
    acted_();
  } catch (const VitalFailure& failure) {  // must not leave a destructor
    asio::post(io_, [failure] { throw failure; });
  }
}

monitor::Message MonitorService::hello(const MonitorSession& session) {
  cell_.catch_up(wall_now());
  const monitor::CellTime now{cell_.epoch(), cell_.state().tick, cell_.clock().mode(),
                              cell_.clock().rate()};
  return monitor::hello({"xr3 " XR3_VERSION, cells(), cell_.model(), now, session.access()});
}

asio::awaitable<std::optional<monitor::Frame>> MonitorService::current_frame(
    monitor::Selection selection) {
  cell_.catch_up(wall_now());
  std::optional<monitor::Frame> frame = co_await frames_.get(std::move(selection));
  co_return frame;
}

void MonitorService::acted() {
  note_work();
  subscribers_.acted();
}

void MonitorService::stop() {
  subscribers_.stop();
  lag_.stop();
}

CellCounters MonitorService::counters() const {
  CellCounters counters = cell_.counters();
  counters.lines_open = cell_.lines().size();
  counters.monitor_sessions = subscribers_.size();
  counters.wrong_tokens = wrong_tokens_;
  counters.robot_port = lines_.counters();
  counters.loop_lag_ns = lag_.max_at(wall_now());
  const SubscriberHub::AllChannelStats channel_stats = subscribers_.channel_stats();
  for (std::size_t i = 0; i < channel_stats.size(); ++i)
    counters.channels.at(i) = {channel_stats[i].sent, channel_stats[i].overwritten};
  return counters;
}

// --- Requests.

MonitorService::Error MonitorService::refuse(const MonitorSession& session,
                                             std::string_view message) const {
  if (session.access() == Access::kControl) return std::nullopt;
  return check_access(session, monitor::heading_of(message));
}

asio::awaitable<monitor::RequestReading> MonitorService::read(std::string_view message) {
  const auto parse = [message, cells = cells()] { return monitor::read_request(message, cells); };
  if (message.size() <= kMaxParsedAtOnce) co_return parse();
  co_return co_await worker_.run(parse);
}

asio::awaitable<void> MonitorService::carry_out(MonitorSession& session, monitor::Request request) {
  note_work();
  if (const Error error = check_access(session, monitor::heading_of(request))) {
    session.client().send(monitor::result(*error));
  } else if (std::holds_alternative<monitor::Ping>(request.what)) {
    session.client().send(monitor::pong(request.id));
  } else if (std::holds_alternative<monitor::Auth>(request.what)) {
    co_await authorize(session, std::move(request));
  } else if (std::holds_alternative<monitor::Subscribe>(request.what)) {
    co_await subscribe(session, std::move(request));
  } else if (std::holds_alternative<monitor::Unsubscribe>(request.what)) {
    unsubscribe(session, request);
  } else if (std::holds_alternative<monitor::Get>(request.what)) {
    co_await show(session, std::move(request));
  } else {
    co_await call(session, std::move(request));
  }
}

// A wrong token is answered late, so that trying many takes long.
asio::awaitable<void> MonitorService::authorize(MonitorSession& session, monitor::Request request) {
  if (!policy_.needs_token() || policy_.is_right(std::get<monitor::Auth>(request.what).token)) {
    const bool had_no_access = session.access() == Access::kNone;
    session.grant(Access::kControl);
    session.client().send(monitor::result(request.id, {{"access", "control"}}));
    if (had_no_access) session.client().send(hello(session));
    co_return;
  }
  note_wrong_token();
  asio::steady_timer delay(io_, kWrongTokenDelay);
  co_await delay.async_wait(kAwait);
  session.client().send(monitor::result({request.id,
                                         "bad_token",
                                         "this is not the token",
                                         "five wrong ones end the connection",
                                         {}}));
  if (session.note_wrong_token() >= kMaxWrongTokens) session.end(monitor::CloseReason::kBadToken);
}

// At most one message a second, however many clients try.
void MonitorService::note_wrong_token() {
  ++wrong_tokens_;
  const WallNs now = wall_now();
  if (now < next_token_log_) return;
  next_token_log_ = now + kTokenLogEvery;
  spdlog::warn("monitor: a client gave a wrong token; {} since the start", wrong_tokens_);
}

// --- Channels.

monitor::Feed& MonitorService::feed(Channel channel) {
  return channel == Channel::kEvent ? cell_.events() : cell_.wires();
}

asio::awaitable<void> MonitorService::subscribe(MonitorSession& session, monitor::Request request) {
  const auto& wanted = std::get<monitor::Subscribe>(request.what);
  const Channel channel = wanted.selection.channel;
  if (is_feed(channel)) {
    cell_.catch_up(wall_now());
    const std::int64_t next = feed(channel).next();
    const std::int64_t since = std::clamp<std::int64_t>(wanted.since.value_or(next), 1, next);
    session.client().send(monitor::result(request.id, terms(request.cell, wanted, since)));
    session.client().follow_feed(request.cell, wanted, feed(channel));
  } else {
    const std::optional<monitor::Frame> frame = co_await current_frame(wanted.selection);
    if (!frame) {
      session.client().send(monitor::result(no_camera(request.id)));
      co_return;
    }
    session.client().send(monitor::result(request.id, terms(request.cell, wanted, 0)));
    session.client().follow_frames(request.cell, wanted).offer(*frame, subscribers_.now());
  }
  subscribers_.acted();
}

void MonitorService::unsubscribe(MonitorSession& session, const monitor::Request& request) {
  const Channel channel = std::get<monitor::Unsubscribe>(request.what).channel;
  session.client().unfollow(request.cell, channel);
  session.client().send(monitor::result(request.id, Json::object()));
}

asio::awaitable<void> MonitorService::show(MonitorSession& session, monitor::Request request) {
  const auto& get = std::get<monitor::Get>(request.what);
  if (is_feed(get.selection.channel)) {
    cell_.catch_up(wall_now());
    session.client().replay(feed(get.selection.channel), request.cell, get, request.id);
    session.client().send(monitor::result(request.id, Json::object()));
    co_return;
  }
  const std::optional<monitor::Frame> frame = co_await current_frame(get.selection);
  session.client().send(frame ? monitor::with_id(frame->message, request.id)
                              : monitor::result(no_camera(request.id)));
}

}  // namespace xr3
