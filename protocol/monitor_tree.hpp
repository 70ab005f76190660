// The text of one message of a monitor's client as a JSON tree, or what is wrong with it as JSON, in
// plain words with the column, and which members it gives twice. It knows nothing of what requests mean.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
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

/// Tells of each member that its object has already, with its JSON pointer (of a very long one the
/// beginning). `tree` is the message as it was read, where only the last of them is left; unless some
/// are missing there, this is but a count.
void for_each_duplicate(
    std::string_view message, const Tree& tree,
    const std::function<void(const std::string& pointer, const std::string& name)>& tell);

}  // namespace xr3::monitor
