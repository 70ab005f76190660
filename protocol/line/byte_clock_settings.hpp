// The rules of the byte clock, with which simulated time advances only by the bytes of the lines.
// See docs/byte-clock.md.
#pragma once

#include <cstdint>
#include <optional>

namespace xr3 {

struct ByteClockSettings {
  static constexpr std::int64_t kMaxInquiryMs = 60'000;
  static constexpr std::int64_t kMinSettleMs = 10;
  static constexpr std::int64_t kMaxSettleMs = 600'000;

  std::int64_t inquiry_ms = 20;  ///< pass before each inquiry, 0...kMaxInquiryMs
  /// Wall time of silence on the current line after which the robot is run to rest; measured by the
  /// server. nullopt if silence has no effect.
  std::optional<std::int64_t> settle_ms = std::nullopt;
  bool has_concurrent_lines = false;  ///< execute the bytes of all lines as they arrive

  bool operator==(const ByteClockSettings&) const = default;
};

}  // namespace xr3
