// The channels by name, and the members of their messages that a client may choose among. It knows
// nothing of the messages' values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor_request.hpp"

namespace xr3::monitor {

/// `state`, `image`...
std::string_view name_of(Channel channel);

std::optional<Channel> channel_named(std::string_view name);

/// The last message of these counts; of the others, event and line, every message counts.
bool is_latest_wins(Channel channel);

/// Members of the channel's messages beside op, cell, epoch, seq and tick, which always come. Those
/// of `event` are the members of all kinds of events.
const std::vector<std::string>& members_of(Channel channel);

}  // namespace xr3::monitor
