#include "cell/frames.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/digest.hpp"
#include "cell/failure.hpp"
#include "protocol/monitor/display.hpp"
#include "protocol/monitor/image.hpp"
#include "protocol/monitor/model.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

// Maximum number of selections encoded per channel. One more discards the oldest.
constexpr std::size_t kMaxEncoded = 64;

MemberTexts texts_of(const Json& members) {
  MemberTexts texts;
  for (const auto& [name, value] : members.items())
    texts.emplace_back(name, monitor::text_of(value));
  return texts;
}

void append(std::string& object, const std::pair<std::string, std::string>& member) {
  object += object.size() > 1 ? ",\"" : "\"";
  object.append(member.first).append("\":").append(member.second);
}

/// A JSON object with all members, or with the selected ones in the order of selection.
std::string object_text(const MemberTexts& members, const Fields& fields) {
  std::string object = "{";
  if (!fields) {
    for (const auto& member : members) append(object, member);
    return object + "}";
  }
  for (auto name = fields->begin(); name != fields->end(); ++name) {
    const auto found = std::find_if(members.begin(), members.end(),
                                    [&](const auto& member) { return member.first == *name; });
    const bool is_first = std::find(fields->begin(), name, *name) == name;
    if (found != members.end() && is_first) append(object, *found);
  }
  return object + "}";
}

}  // namespace

FrameCache::ChannelCache& FrameCache::cache_of(Channel channel) {
  std::unique_ptr<ChannelCache>& cache = caches_.at(static_cast<std::size_t>(channel));
  if (!cache) cache = std::make_unique<ChannelCache>();
  return *cache;
}

const monitor::Frame* FrameCache::frame(const monitor::Selection& selection) {
  return fatal_if_throws("the frames", [&]() -> const monitor::Frame* {
    ChannelCache& cache = cache_of(selection.channel);
    if (cache.revision != cell_.revision()) update(selection.channel, cache);
    if (selection.channel == Channel::kImage && !cache.image) return nullptr;
    EncodedFrame& encoded = encoded_for(cache, selection);
    if (encoded.seq != cache.seq) make(cache, encoded);
    return &encoded.frame;
  });
}

std::size_t FrameCache::trim() {
  std::size_t bytes = 0;
  for (const std::unique_ptr<ChannelCache>& cache : caches_) {
    if (!cache) continue;
    for (const EncodedFrame& each : cache->encoded)
      bytes += each.frame.message ? each.frame.message->size() : 0;
    cache->encoded = {};
    for (MemberTexts& members : cache->image_members) members = {};
  }
  return bytes;
}

void FrameCache::update(Channel channel, ChannelCache& cache) {
  cache.revision = cell_.revision();
  const bool is_new = cache.seq == 0 || cache.epoch != cell_.epoch();
  if (!has_changed(channel, cache) && !is_new) return;
  ++cache.seq;
  cache.epoch = cell_.epoch();
  cache.tick = cell_.state().tick;
}

bool FrameCache::has_changed(Channel channel, ChannelCache& cache) {
  const bool is_state = channel == Channel::kState;
  const bool is_later = is_state && cache.tick != cell_.state().tick;
  if (channel == Channel::kImage) return has_new_image(cache);
  if (is_state && is_only_later(cache)) return is_later;
  if (channel == Channel::kModel && is_same_model(cache)) return false;
  cache.members = members_of(channel);
  std::string text = object_text(cache.members, std::nullopt);
  const bool is_other = text != cache.text;
  cache.text = std::move(text);
  return is_other || is_later;
}

/// Whether only the tick has changed since the last frame; the text is then still valid.
bool FrameCache::is_only_later(ChannelCache& cache) const {
  Snapshot now = cell_.snapshot();
  now.state.tick = 0;
  const bool is_same = cache.snapshot == now;
  cache.snapshot = std::move(now);
  return is_same;
}

/// Whether the workcell is the same as in the last frame. The robot never changes.
bool FrameCache::is_same_model(ChannelCache& cache) const {
  ShownModel now{cell_.model_rev(), workcell_now(cell_.model(), cell_.state())};
  const bool is_same = cache.model == now;
  cache.model = std::move(now);
  return is_same;
}

bool FrameCache::has_new_image(ChannelCache& cache) const {
  const ImagePtr before = std::exchange(cache.image, cell_.camera_image());
  if (before == cache.image) return false;
  for (MemberTexts& members : cache.image_members) members.clear();
  return !before || !cache.image || *before != *cache.image;
}

MemberTexts FrameCache::members_of(Channel channel) {
  const Model& model = cell_.model();
  const State& state = cell_.state();
  if (channel == Channel::kDisplay) return texts_of(display_json(model, state));
  if (channel == Channel::kState) return states_.encode(model, cell_.snapshot());
  Json members = model_json(model, state, cell_.model_rev(), "");
  members["hash"] = sha256(members["robot"].dump() + members["workcell"].dump());
  return texts_of(members);
}

FrameCache::EncodedFrame& FrameCache::encoded_for(ChannelCache& cache,
                                                  const monitor::Selection& selection) const {
  const auto found = std::find_if(
      cache.encoded.begin(), cache.encoded.end(),
      [&selection](const EncodedFrame& encoded) { return encoded.selection == selection; });
  if (found != cache.encoded.end()) return *found;
  if (cache.encoded.size() >= kMaxEncoded) cache.encoded.pop_front();
  return cache.encoded.emplace_back(EncodedFrame{selection, 0, {}});
}

std::string FrameCache::content_of(ChannelCache& cache, const monitor::Selection& selection) {
  if (!cache.image) return object_text(cache.members, selection.fields);
  if (!selection.fields) return image_text(*cache.image, selection.encoding);
  MemberTexts& members = cache.image_members.at(static_cast<std::size_t>(selection.encoding));
  if (members.empty()) members = texts_of(image_json(*cache.image, selection.encoding));
  return object_text(members, selection.fields);
}

void FrameCache::make(ChannelCache& cache, EncodedFrame& encoded) const {
  const monitor::Selection& selection = encoded.selection;
  const std::string content = content_of(cache, selection);
  encoded.frame.content = monitor::content_id(content);
  encoded.seq = encoded.frame.seq = cache.seq;
  encoded.frame.message = monitor::channel_message(
      selection.channel, {cell_.name(), cache.epoch, cache.seq, cache.tick}, content);
}

}  // namespace xr3
