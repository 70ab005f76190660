// Output of a program under test, for a terminal that must not obey it.
#pragma once

#include <string>
#include <string_view>

namespace xr3 {

/// A stream of text in UTF-8, as printable_lines(). The beginning of a character waits for the rest
/// of it.
class TerminalText {
 public:
  /// The next piece, escaped.
  std::string add(std::string_view text);

 private:
  std::string rest_;
};

}  // namespace xr3
