#include "service/channels.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "service/answer.hpp"

namespace xr3::service {
namespace {

using monitor::Channel;

bool is_feed(Channel channel) { return channel == Channel::kEvent || channel == Channel::kLine; }

/// The ring of a channel without loss, which keeps its cell.
std::shared_ptr<monitor::Feed> feed_of(const WatchedCell& at, Channel channel) {
  return {at.cell, channel == Channel::kEvent ? &at.cell->events() : &at.cell->wires()};
}

monitor::Message no_camera(const monitor::RequestId& id) {
  return refused(id, {"no_camera", "this workcell has no camera",
                      "give the workcell file a camera, or replace it by the call workcell"});
}

monitor::Message too_many(const monitor::RequestId& id) {
  return refused(id,
                 {"limit", "this client has 256 subscriptions",
                  "end one by unsub, or subscribe to the channel overview, which shows all cells"});
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
bool follow_feed(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
                 const monitor::Subscribe& wanted) {
  const std::shared_ptr<monitor::Feed> feed = feed_of(at, wanted.selection.channel);
  const std::int64_t next = feed->next();
  const std::int64_t since = std::clamp<std::int64_t>(wanted.since.value_or(next), 1, next);
  client.send(monitor::result(id, terms(at.cell->name(), wanted, since)));
  client.follow_feed(at.cell->name(), wanted, feed);
  return true;
}

/// Follows a latest-wins channel. Returns false if it is the image, and there is no camera.
bool follow_frames(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
                   const monitor::Subscribe& wanted) {
  const std::string& name = at.cell->name();
  const monitor::Frame* frame = at.frames.frame(wanted.selection);
  client.send(frame ? monitor::result(id, terms(name, wanted, 0)) : no_camera(id));
  if (frame == nullptr) return false;
  client.follow_frames(name, wanted).offer(*frame, at.now);
  return true;
}

}  // namespace

bool subscribe(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
               const monitor::Subscribe& wanted) {
  const Channel channel = wanted.selection.channel;
  const bool is_new = !client.follows(at.cell->name(), channel);
  if (is_new && client.subscriptions() >= kMaxSubscriptions) {
    client.send(too_many(id));
    return false;
  }
  return is_feed(channel) ? follow_feed(at, client, id, wanted)
                          : follow_frames(at, client, id, wanted);
}

void unsubscribe(const std::string& cell, monitor::Client& client, const monitor::RequestId& id,
                 const monitor::Unsubscribe& wanted) {
  client.unfollow(cell, wanted.channel);
  client.send(monitor::result(id, Json::object()));
}

void get(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
         const monitor::Get& wanted) {
  const Channel channel = wanted.selection.channel;
  if (is_feed(channel)) {
    client.replay(feed_of(at, channel), at.cell->name(), wanted, id);
    client.send(monitor::result(id, Json::object()));
  } else {
    const monitor::Frame* frame = at.frames.frame(wanted.selection);
    client.send(frame ? monitor::with_id(frame->message, id) : no_camera(id));
  }
}

}  // namespace xr3::service
