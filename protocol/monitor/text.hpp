// Whether the text of a monitor's message is an object of JSON, or what is wrong with it, in plain words
// with the column. It knows nothing of what requests mean.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

/// What can be told before it is read: `too_long`, `too_deep`, or `bad_json` of a NUL byte; without an id.
std::optional<RequestError> refuse_text(std::string_view message);

/// What reading it has found: `bad_json`, also of what is no object.
std::optional<RequestError> refuse_document(const JsonDocument& document);

}  // namespace xr3::monitor
