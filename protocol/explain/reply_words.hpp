// Replies of the controller as text: a stable code and a short phrase.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// The stable code, such as `reply_error`.
std::string_view code_of(const wire::Answered& answered);

/// The meaning of the reply, such as `E: 4 counts to go`. `model` gives the joints of the switch
/// bits and the profile of the reply's bytes.
std::string describe(const wire::Answered& answered, const Model& model);

}  // namespace xr3
