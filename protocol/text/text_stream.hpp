// A stream that makes a text.
#pragma once

#include <sstream>

namespace xr3 {

/// Throws std::bad_alloc if memory ends. A std::ostringstream drops the rest of the text without
/// notice instead.
class TextStream : public std::ostringstream {
 public:
  TextStream() { exceptions(std::ios_base::badbit); }
};

}  // namespace xr3
