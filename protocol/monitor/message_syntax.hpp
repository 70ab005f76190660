// Checks whether the text of a message is a JSON object; if not, describes the error with its
// column. Independent of the meaning of requests.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {

/// Errors found before parsing: `too_long`, `too_deep`, or `bad_json` for a NUL byte; without an
/// id.
std::optional<RequestError> refuse_text(std::string_view message);

/// Errors found by parsing: `too_deep`, or `bad_json` for invalid JSON or a value other than an
/// object.
std::optional<RequestError> refuse_document(const JsonDocument& document);

}  // namespace xr3::monitor
