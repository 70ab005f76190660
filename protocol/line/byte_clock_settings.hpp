// The rules of the byte clock, with which time moves with the bytes of the lines alone. See
// docs/byte-clock.md.
#pragma once

#include <cstdint>
#include <optional>

namespace xr3 {

struct ByteClockSettings {
  static constexpr std::int64_t kMaxInquiryMs = 60'000;
  static constexpr std::int64_t kMinSettleMs = 10;
  static constexpr std::int64_t kMaxSettleMs = 600'000;

  std::int64_t inquiry_ms = 20;  ///< pass before each inquiry, 0...kMaxInquiryMs
  /// So much wall time of silence on the current line runs the robot to rest; the server measures
  /// it. nullopt: silence has no effect.
  std::optional<std::int64_t> settle_ms = std::nullopt;
  bool has_concurrent_lines = false;  ///< all lines are obeyed, not one at a time

  bool operator==(const ByteClockSettings&) const = default;
};

}  // namespace xr3
