// The table of calls: name, purpose, and the function that reads the args into a value. The same
// function yields the description of the args. Independent of the cell.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

using CallValue = decltype(CallRequest::call);

struct CallForm {
  std::string_view fn;
  std::string_view purpose;  ///< one sentence
  CallValue (*read)(ArgsReader&);
  enum class Time : std::uint8_t { kStays, kMoves } time = Time::kStays;  ///< kMoves: after, fields
};

/// The names of all calls, as listed in `hello`.
const std::vector<std::string>& calls();

/// nullptr if there is no such call.
const CallForm* find_call(std::string_view fn);

/// Reads the args of a `call` request; `members` reads the members of the request.
CallRequest read_call(const CallForm& form, ArgsReader& members);

/// `{"calls":[{"fn","purpose","args":[{"name","required","allowed"}]}]}` of one call, or of all.
Json description(const std::optional<std::string>& fn);

}  // namespace xr3::monitor
