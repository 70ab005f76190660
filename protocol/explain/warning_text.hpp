// The sentences of the machine's warnings.
#pragma once

#include <string>

#include "core/event.hpp"
#include "core/model.hpp"

namespace xr3 {

/// What happened and what to do, without a full stop.
std::string text_of(const Warning& warning, const Model& model);

/// A letter as a text.
inline std::string letter_text(char letter) { return {letter}; }

/// At most six digits.
std::string short_number(double value);

}  // namespace xr3
