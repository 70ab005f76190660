// What a new connection speaks, told by its first byte that is no blank, CR, LF or byte order mark.
// What was decided stays: HTTP never becomes lines, lines never HTTP.
#pragma once

#include <cstdint>
#include <string_view>

namespace xr3::monitor {

enum class Tongue : std::uint8_t {
  kUndecided,  ///< nothing that says anything has come yet
  kLines,      ///< JSON, an object a line
  kHttp,
  kTls,      ///< not spoken here
  kNotJson,  ///< none of them
};

class Opening {
 public:
  /// Looks at more bytes and returns how many of them say nothing, to be skipped. When tongue() is
  /// decided, the rest belongs to whoever speaks it.
  std::size_t take(std::string_view bytes);

  Tongue tongue() const { return tongue_; }

  /// There was silence, and `hello` has been sent: it can only be lines from now on.
  void settle_for_lines() { only_lines_ = true; }

 private:
  void decide(char byte);

  std::size_t mark_bytes_ = 0;  ///< of the byte order mark, so far
  bool only_lines_ = false;
  Tongue tongue_ = Tongue::kUndecided;
};

}  // namespace xr3::monitor
