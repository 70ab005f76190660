// Plain words for a JSON syntax error: line, column, what stands there and what may stand there,
// made from the parser's message. It knows nothing of what the file describes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/finding.hpp"

namespace xr3 {

/// What nlohmann-json's parser tells of an error.
struct SyntaxError {
  std::size_t position;  ///< characters read, the offending one included
  std::string token;     ///< the token read last, possibly with what came before it
  std::string message;
};

/// The finding for a syntax error in `text`; its pointer is empty, its column from 1.
Finding syntax_finding(std::string_view text, const std::string& file, const SyntaxError& error);

}  // namespace xr3
