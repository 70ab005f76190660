// Bytes into lines, however they were cut up on their way: a line ends with LF, CR LF, or where the
// client stops sending; blank lines are nothing. A line that does not begin with `{` is never read,
// nor is anything behind it. It knows no JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace xr3::monitor {

/// Why no further line will come.
enum class LineFault : std::uint8_t { kNone, kNotJson, kTooLong };

class Lines {
 public:
  /// Takes bytes. Call next() until it gives nothing before taking more: what is kept stays bounded
  /// by one line and one read.
  void take(std::string_view bytes);

  /// The client has stopped sending: what stands there is the last line.
  void end() { has_ended_ = true; }

  /// The next line that is whole, without its end and without blanks in front; valid until the next
  /// call of a member. Nothing where none is whole yet, or where fault() says that none will be.
  std::optional<std::string_view> next();

  LineFault fault() const { return fault_; }

 private:
  void skip_blanks();
  std::optional<std::string_view> fail(LineFault fault);

  std::string bytes_;
  std::size_t begin_ = 0;    ///< of the line that comes next
  std::size_t scanned_ = 0;  ///< no line end before this
  bool has_ended_ = false;
  LineFault fault_ = LineFault::kNone;
};

}  // namespace xr3::monitor
