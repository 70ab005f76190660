// The text of one message of a monitor's client as a JSON tree, or what is wrong with it as JSON, in
// plain words with the column. It knows nothing of what requests mean.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "protocol/monitor_request.hpp"

namespace xr3::monitor {

/// A message as it was parsed: a map, so that no message is slow to take in.
using Tree = nlohmann::json;

/// An object, or the error `too_long`, `too_deep` or `bad_json`, without an id.
using TreeReading = std::variant<Tree, RequestError>;

/// Never throws.
TreeReading read_tree(std::string_view message);

}  // namespace xr3::monitor
