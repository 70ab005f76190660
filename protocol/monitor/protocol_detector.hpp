// Detects the protocol of a new connection by its first byte that is not a blank, CR, LF or byte
// order mark. The decision is final.
#pragma once

#include <cstdint>
#include <string_view>

namespace xr3::monitor {

enum class Protocol : std::uint8_t {
  kUndecided,  ///< no significant byte yet
  kLines,      ///< one JSON object per line
  kHttp,
  kTls,      ///< not supported
  kNotJson,  ///< neither of these
};

class ProtocolDetector {
 public:
  /// Examines more bytes. Returns the number of insignificant bytes at their start, which the
  /// caller must skip. Once protocol() is decided, the rest belongs to that protocol.
  std::size_t feed(std::string_view bytes);

  Protocol protocol() const { return protocol_; }

  /// Excludes all but kLines: the client was silent and has been sent `hello`.
  void settle_for_lines() { only_lines_ = true; }

 private:
  void decide(char byte);

  std::size_t mark_bytes_ = 0;  ///< bytes of the byte order mark seen so far
  bool only_lines_ = false;
  Protocol protocol_ = Protocol::kUndecided;
};

}  // namespace xr3::monitor
