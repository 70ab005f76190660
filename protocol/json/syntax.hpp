// Describes the fault of a text that is not JSON, derived from the parser's message: line, column,
// what was found and what is allowed there. Independent of the file's meaning.
#pragma once

#include <string>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// The finding for a document with a fault. A syntax error has a column and no pointer; of
/// nesting that is too deep, the pointer names the enclosing value.
Finding fault_finding(const JsonDocument& document, const std::string& file);

}  // namespace xr3
