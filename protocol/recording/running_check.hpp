// The check of a recording: a CRC of all its bytes so far, at the end of each line, so that a
// changed byte is found in its line. It detects accidents, not
// intent: the check can be computed anew after a change.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace xr3::recording {

class RunningCheck {
 public:
  /// The number of characters of text().
  static constexpr std::size_t kSize = 4;

  void add(std::string_view bytes);
  /// The CRC-24 of RFC 4880 of all bytes, in four characters of base64url. It differs for any two
  /// texts of one length that differ in one byte only.
  std::string text() const;

 private:
  std::uint32_t crc_ = 0xB704CE;
};

}  // namespace xr3::recording
