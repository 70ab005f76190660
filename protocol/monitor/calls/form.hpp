// One call of the monitor: name, purpose, and how its arguments are read and written. The forms of
// related calls are in one file each; call_table.hpp joins them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

using CallValue = decltype(CallRequest::call);

/// A read function reads the args of a call into its value. It requests every argument regardless
/// of what it finds, so that reading an empty object yields the description of the call. If there
/// are findings, the returned value is meaningless.
using ReadCall = CallValue (*)(ArgsReader&);
/// The exact inverse, for recordings: the args of a call, or nullopt if it is another call.
using WriteCall = std::optional<Json> (*)(const call::Call&);

struct CallForm {
  std::string_view fn;
  std::string_view purpose;  ///< one sentence
  ReadCall read;
  WriteCall write = nullptr;  ///< null: the cell does not execute the call, so it is not recorded
  enum class Time : std::uint8_t { kStays, kMoves } time = Time::kStays;  ///< kMoves: after, fields
};
using CallForms = std::span<const CallForm>;

CallForms time_calls();
CallForms machine_calls();
CallForms workcell_calls();
CallForms snapshot_calls();
CallForms fault_calls();
CallForms line_calls();
CallForms past_calls();
CallForms server_calls();

// --- For the files of these functions.

/// The WriteCall of a call, by a function that writes its args.
template <class Call, Json (*Write)(const Call&)>
std::optional<Json> write_as(const call::Call& call) {
  const Call* one = std::get_if<Call>(&call);
  return one == nullptr ? std::nullopt : std::optional(Write(*one));
}

template <class Call>
CallValue read_nothing(ArgsReader&) {
  return Call{};
}
template <class Call>
std::optional<Json> write_nothing(const call::Call& call) {
  return std::holds_alternative<Call>(call) ? std::optional<Json>(Json::object()) : std::nullopt;
}

/// An object in the form of a file; empty if it is omitted or invalid. Records the error. Objects
/// of more members than any valid document has are refused: comparing their names would take long.
JsonValue document(ArgsReader& args, const std::string& name, Presence presence,
                   const std::string& allowed);

}  // namespace xr3::monitor
