// The names of the channels and of those members of their messages that a client can select.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

/// The name of a channel, such as `state` or `image`.
std::string_view name_of(Channel channel);

/// The channel with this name, or nullopt.
std::optional<Channel> channel_named(std::string_view name);

/// The names of all channels, as listed in `hello`.
const std::vector<std::string>& channels();

/// Whether a channel of a cell skips messages for slow clients. The other channels of a cell, event
/// and line, report a lag. `overview` is none of either.
bool is_latest_wins(Channel channel);

/// The members of the channel's messages except op, cell, epoch, seq and tick, which are always
/// included. For `event`: the members of all kinds of events.
const std::vector<std::string>& members_of(Channel channel);

}  // namespace xr3::monitor
