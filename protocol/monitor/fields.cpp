#include "protocol/monitor/fields.hpp"

#include <algorithm>
#include <array>

namespace xr3::monitor {
namespace {

std::vector<std::string> event_members() {
  return {"event",  "line",  "code",       "message",  "joint",     "counts",    "count",
          "error",  "by",    "closed",     "block",    "xyz_mm",    "yaw_deg",   "input",
          "output", "aux",   "value",      "enabled",  "offset",    "hex",       "kind",
          "peer",   "clock", "from_epoch", "bytes_in", "from_tick", "bytes_out", "model_rev",
          "device", "fault", "phase",      "effects",  "waits_for", "file",      "other_line"};
}

/// The members of each channel, indexed by Channel.
const std::array<std::vector<std::string>, kChannels>& members() {
  static const std::array<std::vector<std::string>, kChannels> lists = {{
      state_members(),
      {"width", "height", "encoding", "rows"},
      {"on", "view", "erase", "period_ticks", "function_keys", "extents_mm", "polylines", "status"},
      {"rev", "robot", "workcell", "hash"},
      event_members(),
      {"line", "dir", "offset", "hex", "text", "bytes", "parsed"},
      {"whole", "cells", "closed"},
  }};
  return lists;
}

/// The names of the channels, indexed by Channel.
constexpr std::array<std::string_view, kChannels> kNames = {"state", "image", "display", "model",
                                                            "event", "line",  "overview"};

std::size_t index_of(Channel channel) { return static_cast<std::size_t>(channel); }

}  // namespace

std::string_view name_of(Channel channel) { return kNames[index_of(channel)]; }

std::optional<Channel> channel_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Channel>(found - kNames.begin());
}

bool is_latest_wins(Channel channel) { return channel < Channel::kEvent; }

const std::vector<std::string>& members_of(Channel channel) { return members()[index_of(channel)]; }

const std::vector<std::string>& channels() {
  using enum Channel;
  static const std::vector<std::string> listed = [] {
    std::vector<std::string> names;
    for (const Channel each : {kState, kImage, kEvent, kLine, kDisplay, kModel, kOverview})
      names.emplace_back(name_of(each));
    return names;
  }();
  return listed;
}

}  // namespace xr3::monitor
