// Describes a JSON syntax error, derived from the parser's message: line, column, what was found
// and what is allowed there. Independent of the file's meaning.
#pragma once

#include <string>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// The finding for a syntax error in `text`. Its pointer is empty; its column counts from 1.
Finding syntax_finding(std::string_view text, const std::string& file,
                       const JsonDocument::Complaint& error);

}  // namespace xr3
