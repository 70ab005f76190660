// The reason why a request is refused, as in a `result` with an error.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

/// An invalid value at a JSON pointer in the message; `found` is null if it is missing.
struct Detail {
  std::string pointer;
  Json found;
  std::string allowed;
};

/// `code` is stable.
struct RequestError {
  RequestId id;
  std::string code;
  std::string message;
  std::string hint;
  std::vector<Detail> details;
  Json more = Json::object();  ///< further members of the error, by its code
};

}  // namespace xr3::monitor
