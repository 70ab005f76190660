// Calls as JSON: the exact inverse of the readers in protocol/monitor/call_table.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "protocol/json/codec.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3::recording {

/// Name and arguments, as in a request of the monitor port.
struct CallJson {
  std::string fn;
  Json args;
};
CallJson call_to_json(const call::Call& call);

/// Reads what call_to_json() has made. `args` may be empty: no arguments. Reports errors at `fn`
/// and in `args`.
std::optional<call::Call> read_call_json(const data::Place& fn, JsonValue args);

}  // namespace xr3::recording
