// The table of calls: each name with what it is for and how its args are read into a value. What it
// takes is told by the very code that reads it. It knows no cell.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

using CallValue = decltype(CallRequest::call);

/// One call.
struct CallForm {
  std::string_view fn;
  std::string_view purpose;  ///< one sentence
  CallValue (*read)(ArgsReader&);
  enum class Time : std::uint8_t { kStays, kMoves } time = Time::kStays;  ///< kMoves: after, fields
};

/// Null where there is no such call.
const CallForm* find_call(std::string_view fn);

/// Reads the args of a request to carry out a call; `members` are those of the request.
CallRequest read_call(const CallForm& form, ArgsReader& members);

/// `{"calls":[{"fn","purpose","args":[{"name","required","allowed"}]}]}`: one call, or every one.
Json description(const std::optional<std::string>& fn);

}  // namespace xr3::monitor
