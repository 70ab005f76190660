// Tells robot, workcell, fault and goals files apart.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

enum class DataKind : std::uint8_t { kUnknown, kRobot, kWorkcell, kFaults, kGoals };

/// With `joints` it is a robot, with `workspace` or `blocks` a workcell, with `faults` a list of
/// faults, with `goals` one of goals.
DataKind kind_of(JsonValue root);

/// The only finding of a file of the other kind: one sentence says more than a list of all members
/// that it lacks. Throws DataError if the file is of another known kind than `wanted`.
void refuse_other_kinds(JsonValue root, DataKind wanted, const std::string& file);

/// What a file of a kind is: `a robot, with "joints" and "tool"`.
const char* description_of(DataKind kind);

}  // namespace xr3
