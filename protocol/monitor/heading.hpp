// What a message asks for, as far as it matters for access, without reading the message: only the names of
// its outermost members are looked at, and of these `op`, `fn` and `id` are read. The rest may be anything.
#pragma once

#include <string>
#include <string_view>

#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

struct Heading {
  RequestId id;
  std::string op;  ///< empty: there is none, or none of this version
  std::string fn;  ///< the same
};

/// Never throws, and takes no memory to speak of.
Heading heading_of(std::string_view message);

/// The heading of a request that was read.
Heading heading_of(const Request& request);

}  // namespace xr3::monitor
