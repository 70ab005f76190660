// Messages of the monitor port as the values of watch_known, member by member. A member that is
// missing or of another type leaves its value as it was: a server may be older or newer than we are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/json_source.hpp"
#include "protocol/watch_known.hpp"

namespace xr3::watch {

/// Widest and highest image that is taken, in pixels.
inline constexpr std::size_t kMostPixels = 4096;

/// The member, or null where there is none or this is no object.
const Json& member(const Json& object, const char* name);

void read(const Json& object, const char* name, std::string& into);
void read(const Json& object, const char* name, std::int64_t& into);
void read(const Json& object, const char* name, double& into);
void read(const Json& object, const char* name, bool& into);
void read(const Json& object, const char* name, std::array<double, 3>& into);
void read(const Json& object, const char* name, std::vector<bool>& into);

/// The member, or `otherwise`.
template <class Value>
Value value_of(const Json& object, const char* name, Value otherwise = {}) {
  read(object, name, otherwise);
  return otherwise;
}

/// The members of a `state` message.
State read_state(const Json& message);
/// A clock as `state` and `hello` have it.
void read_clock(const Json& clock, Known& known);
/// Label and limits of a joint or tool as in a robot file.
void read_limits(const Json& drive, std::map<std::string, Limits>& limits);
/// An `image` message as pixels, of either encoding; nothing if it contradicts itself.
std::optional<Image> read_image(const Json& message);

}  // namespace xr3::watch
