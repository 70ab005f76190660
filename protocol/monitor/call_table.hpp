// The table of calls. The function that reads the args of a call yields their description, too.
// Independent of the cell.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {

/// The names of all calls, as listed in `hello`.
const std::vector<std::string>& calls();

/// The form of a call; nullptr if there is no such call.
const CallForm* find_call(std::string_view fn);

/// Reads the args of a `call` request; `members` reads the members of the request.
CallRequest read_call(const CallForm& form, ArgsReader& members);

/// Name and args of a call that a cell executes, as in a request.
struct WrittenCall {
  std::string_view fn;
  Json args;
};
WrittenCall written(const call::Call& call);

/// `{"calls":[{"fn","purpose","args":[{"name","required","allowed"}]}]}` of one call, or of all.
Json description(const std::optional<std::string>& fn);

}  // namespace xr3::monitor
