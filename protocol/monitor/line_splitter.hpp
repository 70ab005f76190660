// Splits a byte stream into lines. A line ends with LF, CR LF or the end of the stream; blank lines
// are skipped. A line that does not begin with `{` is an error: neither it nor anything after it is
// read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace xr3::monitor {

/// The reason why there will be no further line.
enum class LineFault : std::uint8_t { kNone, kNotJson, kTooLong };

class LineSplitter {
 public:
  /// Appends bytes. Call next() until it returns nullopt before adding more; the buffer is then
  /// bounded by one line plus one read.
  void feed(std::string_view bytes);

  /// Makes the buffered rest the last line, after the client has closed its side.
  void end() { has_ended_ = true; }

  /// The next complete line, without its line end and leading blanks; valid until the next call of
  /// a member. nullopt if no line is complete yet, or if fault() is set.
  std::optional<std::string_view> next();

  LineFault fault() const { return fault_; }

  /// The number of bytes in the buffer.
  std::size_t size() const { return bytes_.size() - begin_; }

 private:
  void skip_blanks();
  std::optional<std::string_view> fail(LineFault fault);

  std::string bytes_;
  std::size_t begin_ = 0;    ///< start of the next line
  std::size_t scanned_ = 0;  ///< no line end before this
  bool has_ended_ = false;
  LineFault fault_ = LineFault::kNone;
};

}  // namespace xr3::monitor
