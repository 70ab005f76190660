// Messages of a monitor port about a small robot with a camera, for tests of `xr3 watch`.
#pragma once

#include <string>
#include <vector>

#include "tools/watch/model.hpp"

namespace xr3::test {

/// `hello` with this access, "control" or "read".
std::string watched_hello(const std::string& access = "control");
/// Model, state and image, and three events: each a line without its line end.
std::vector<std::string> watched_messages();
/// The state with `from`, which must be present, replaced by `to`.
std::string watched_state(const std::string& from = "", const std::string& to = "");

/// The result of the call `lines`: a device that is not there, a TCP connection and a terminal.
std::string watched_lines();

/// A model that has handled all of these messages.
watch::WatchModel watched_model(watch::Wish wish = {});

}  // namespace xr3::test
