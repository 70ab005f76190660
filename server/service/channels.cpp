#include "server/service/channels.hpp"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "server/net/wall_clock.hpp"
#include "server/service/calls.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

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

monitor::Message no_camera(const monitor::RequestId& id) {
  return refused(id, {"no_camera", "this workcell has no camera",
                      "give the workcell file a camera, or replace it by the call workcell"});
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

/// Follows a channel without loss.
void follow_feed(HostedCell& at, MonitorSession& session, const monitor::RequestId& id,
                 const monitor::Subscribe& wanted) {
  at.cell().catch_up(wall_now());
  const std::shared_ptr<monitor::Feed> feed = feed_of(at, wanted.selection.channel);
  const std::int64_t next = feed->next();
  const std::int64_t since = std::clamp<std::int64_t>(wanted.since.value_or(next), 1, next);
  session.send(monitor::result(id, terms(at.name(), wanted, since)));
  session.client().follow_feed(at.name(), wanted, feed);
}

/// Follows a latest-wins channel. Returns false if it is the image, and there is no camera.
bool follow_frames(HostedCell& at, MonitorSession& session, const monitor::RequestId& id,
                   const monitor::Subscribe& wanted) {
  const monitor::Frame* frame = current_frame(at, wanted.selection);
  session.send(frame ? monitor::result(id, terms(at.name(), wanted, 0)) : no_camera(id));
  if (frame == nullptr) return false;
  session.client().follow_frames(at.name(), wanted).offer(*frame, at.hub().now());
  return true;
}

}  // namespace

void MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                const monitor::RequestId& id, const monitor::Subscribe& wanted) {
  const Channel channel = wanted.selection.channel;
  if (channel == Channel::kOverview) return follow_overview(session, id, wanted);
  const monitor::Client& client = session.client();
  if (!client.follows(at->name(), channel) && client.subscriptions() >= kMaxSubscriptions) {
    return session.send(
        refused(id, {"limit", "this client has 256 subscriptions",
                     "end one by unsub, or subscribe to the channel overview, which shows all "
                     "cells"}));
  }
  if (is_feed(channel))
    follow_feed(*at, session, id, wanted);
  else if (!follow_frames(*at, session, id, wanted))
    return;
  at->hub().add(session);
  at->hub().changed();
}

void MonitorChannels::follow_overview(MonitorSession& session, const monitor::RequestId& id,
                                      const monitor::Subscribe& wanted) {
  const monitor::MilliHz rate = std::min(wanted.max_millihz, monitor::kMaxOverviewMilliHz);
  session.send(monitor::result(
      id, {{"channel", "overview"}, {"max_hz", static_cast<double>(rate) / 1000.0}}));
  session.client().follow_overview(rate);
  overview_.add(session);
}

void MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                const monitor::RequestId& id, const monitor::Unsubscribe& wanted) {
  monitor::Client& client = session.client();
  if (wanted.channel == Channel::kOverview) {
    client.unfollow_overview();
    overview_.remove(session);
  } else {
    client.unfollow(at->name(), wanted.channel);
    if (!client.follows(at->name())) at->hub().remove(session);
  }
  session.send(monitor::result(id, Json::object()));
}

asio::awaitable<void> MonitorChannels::carry_out(const CellPtr& at, MonitorSession& session,
                                                 const monitor::RequestId& id,
                                                 const monitor::Get& wanted) {
  const Channel channel = wanted.selection.channel;
  if (channel == Channel::kOverview) {
    const std::vector<monitor::CellSummary> cells = co_await overview_.summaries();
    session.send(monitor::with_id(overview_.whole(session, cells), id));
  } else if (is_feed(channel)) {
    at->cell().catch_up(wall_now());
    session.client().replay(feed_of(*at, channel), at->name(), wanted, id);
    session.send(monitor::result(id, Json::object()));
  } else {
    const monitor::Frame* frame = current_frame(*at, wanted.selection);
    session.send(frame ? monitor::with_id(frame->message, id) : no_camera(id));
  }
}

}  // namespace xr3
