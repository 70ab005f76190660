// Reads the calls of a recording, which monitor::written() has made.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "protocol/json/codec.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3::recording {

/// Reads what monitor::written() has made. `args` may be empty: no arguments. Reports errors at `fn`
/// and in `args`.
std::optional<call::Call> read_call_json(const data::Place& fn, JsonValue args);

}  // namespace xr3::recording
