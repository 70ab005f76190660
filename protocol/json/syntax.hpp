// Plain words for a JSON syntax error: line, column, what stands there and what may stand there,
// made from the parser's message. It knows nothing of what the file describes.
#pragma once

#include <string>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// The finding for a syntax error in `text`; its pointer is empty, its column from 1.
Finding syntax_finding(std::string_view text, const std::string& file,
                       const JsonDocument::Complaint& error);

}  // namespace xr3
