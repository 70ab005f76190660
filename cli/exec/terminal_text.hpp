// Output of a program under test, without the control characters that a terminal would execute.
#pragma once

#include <string>
#include <string_view>

namespace xr3 {

/// A stream of text in UTF-8, escaped like printable_lines(). An incomplete character is kept until
/// its rest arrives.
class TerminalText {
 public:
  /// The next piece, escaped.
  std::string add(std::string_view text);

 private:
  std::string rest_;
};

}  // namespace xr3
