// What a reply of the controller means, in words: a stable code and one plain phrase.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/wire_record.hpp"

namespace xr3 {

/// The stable code, as in `reply_error`.
std::string_view code_of(const wire::Answered& answered);

/// What the reply says, as in `E: 4 counts to go`. `model` names the joints behind the bits and the
/// profile in which the bytes are written.
std::string describe(const wire::Answered& answered, const Model& model);

}  // namespace xr3
