// The parts of a message that determine access, without parsing the message: examines only the
// names of the outermost members and reads `op`, `fn` and `id`. The rest may be invalid.
#pragma once

#include <string>
#include <string_view>

#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

struct Heading {
  RequestId id;
  std::string op;  ///< empty if missing or not known to this version
  std::string fn;  ///< empty if missing or not known to this version
};

/// The heading of a message. Never throws. Needs only a small, bounded amount of memory.
Heading heading_of(std::string_view message);

/// The heading of a parsed request.
Heading heading_of(const Request& request);

}  // namespace xr3::monitor
