// Distinguishes robot, workcell, fault, goals and exercise files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "protocol/json/codec.hpp"

namespace xr3 {

enum class DataKind : std::uint8_t { kUnknown, kRobot, kWorkcell, kFaults, kGoals, kExercise };

/// The kind of a file: with `title` an exercise; else with `joints` a robot, with `workspace` or
/// `blocks` a workcell, with `faults` a list of faults, with `goals` one of goals.
DataKind kind_of(JsonValue root);

/// The only finding of a file of the other kind: one sentence says more than a list of all members
/// that it lacks. Throws DataError if the file is of another known kind than `wanted`.
void refuse_other_kinds(JsonValue root, DataKind wanted, const std::string& file);

/// Reads a file of a kind: `read(reading)` reads its value; errors go to the reading. Syntax errors
/// are findings, too. Never throws.
template <class Read>
auto read_file(std::string_view text, const std::string& file, DataKind kind, data::Unit unit,
               const Read& read)
    -> FileReading<typename std::invoke_result_t<Read, data::Reading&>::value_type> try {
  const JsonSource source(text, file);
  refuse_other_kinds(source.root(), kind, file);
  data::Reading reading(source, unit);
  auto value = read(reading);
  return {std::move(value), reading.take_findings()};
} catch (const DataError& error) {
  return {std::nullopt, error.findings()};
}

/// A description of the kind: `a robot, with "joints" and "tool"`.
const char* description_of(DataKind kind);

}  // namespace xr3
