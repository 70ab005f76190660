// A string stream that fails loudly when memory ends.
#pragma once

#include <sstream>

namespace xr3 {

/// Throws std::bad_alloc if memory ends. A std::ostringstream silently drops the rest of the text
/// instead.
class TextStream : public std::ostringstream {
 public:
  TextStream() { exceptions(std::ios_base::badbit); }
};

}  // namespace xr3
