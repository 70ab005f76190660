// Reads messages of the monitor port into the values of watched_cell.hpp. A member that is missing
// or has another type leaves its value unchanged: the server may be older or newer than this
// client.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/monitor/member_reader.hpp"
#include "tools/watch/watched_cell.hpp"

namespace xr3::watch {

using monitor::member;
using monitor::read;
using monitor::value_of;

/// Maximum width and height of an accepted image, in pixels.
inline constexpr std::size_t kMaxPixels = 4096;

/// Reads a `state` message.
WatchedState read_state(const Json& message);
/// Reads the value of the call `lines`.
std::vector<LineEntry> read_lines(const Json& value);
/// Reads a `display` message.
Display read_display(const Json& message);
/// Reads the member `clock` of `state` and `hello`.
void read_clock(const Json& clock, Known& known);
/// Reads label and limits of a joint or the tool, in the form of a robot file.
void read_limits(const Json& drive, std::map<std::string, VariableRange>& limits);
/// Reads an `image` message of either encoding; nullopt if it is inconsistent.
std::optional<WatchedImage> read_image(const Json& message);

}  // namespace xr3::watch
