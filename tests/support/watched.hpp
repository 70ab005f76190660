// What a monitor port says of a small robot with a camera, for tests of `xr3 watch`.
#pragma once

#include <string>
#include <vector>

#include "protocol/watch_model.hpp"

namespace xr3::test {

/// The greeting with this access, "control" or "read".
std::string watched_hello(const std::string& access = "control");
/// Its model, state and image, and three events: each a line without its end.
std::vector<std::string> watched_messages();
/// The state alone, in which one text is replaced by another; the first must be there.
std::string watched_state(const std::string& from = "", const std::string& to = "");

/// Somebody who took all of these.
watch::WatchModel watched_model(watch::Wish wish = {});

}  // namespace xr3::test
