// Tells robot files and workcell files apart.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

enum class DataKind : std::uint8_t { kUnknown, kRobot, kWorkcell };

/// With `joints` it is a robot, with `workspace` or `blocks` a workcell.
DataKind kind_of(JsonValue root);

/// The only finding of a file of the other kind: one sentence says more than a list of all members
/// that it lacks. Throws DataError if the file is of the kind `other`.
void refuse_kind(JsonValue root, DataKind other, const std::string& file);

}  // namespace xr3
