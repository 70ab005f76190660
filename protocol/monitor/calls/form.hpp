// One call of the monitor: name, purpose, and how its arguments are read and written. The forms of
// related calls are in one file each; call_table.hpp joins them.
//
// The flow through the folder: each source defines one of the functions below, such as
// time_calls(), which returns a table with a row for each of its calls. call_table.hpp joins the
// tables; their order is that of `hello` and of `describe`. read_call() finds the row of a
// request's `fn` and runs its read function with an ArgsReader (protocol/monitor/arguments.hpp),
// which checks each argument and records every error. To describe a call, the same read function is
// run on an empty object: the reader then lists the arguments that were requested and their allowed
// values, so that checks and description cannot differ. The write function is the inverse: it
// writes the arguments of an executed call into a recording, from which a replay reads them again.
// The cell executes the calls (cell/calls/), the server those without a write function.
#pragma once

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
/// of the values, so that reading an empty object yields the description of the call. If there are
/// findings, only the type of the returned value has a meaning.
using ReadCall = CallValue (*)(ArgsReader&);
/// A write function is the exact inverse, for recordings: the args of a call, or nullopt if it is
/// another call.
using WriteCall = std::optional<Json> (*)(const call::Call&);

struct CallForm {
  std::string_view fn;
  std::string_view purpose;  ///< one sentence
  ReadCall read;
  WriteCall write = nullptr;  ///< nullptr if the call is not recorded
};
using CallForms = std::span<const CallForm>;

CallForms time_calls();
CallForms machine_calls();
CallForms inverse_calls();
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
