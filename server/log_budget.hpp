// Limits the bytes of the log, so that no client can fill a disk or overload the program that reads
// the log. Independent of the logging library and of the clock.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "server/net/wall_clock.hpp"

namespace xr3 {

/// Bytes that may be logged at once, such as when a class connects, and in each second after that.
inline constexpr std::size_t kMaxLogBurst = std::size_t{256} * 1024;
inline constexpr std::size_t kMaxLogBytesPerSecond = std::size_t{64} * 1024;

class LogBudget {
 public:
  explicit LogBudget(WallNs now) : granted_at_(now / kGrantEvery), reported_at_(now / kSecond) {}

  /// Whether a message may be written now. If not, it counts as dropped. `reserve`: bytes that must
  /// remain for other messages.
  bool admit(WallNs now, std::size_t reserve = 0) {
    grant(now / kGrantEvery);
    if (left_ > reserve) return true;
    ++dropped_;
    return false;
  }

  void spend(std::size_t bytes) { left_ -= std::min(left_, bytes); }

  /// The number of messages dropped since the last report, at most once a second; 0 if no report is
  /// due.
  std::uint64_t drain_dropped(WallNs now) {
    if (dropped_ == 0 || now / kSecond == reported_at_) return 0;
    reported_at_ = now / kSecond;
    return std::exchange(dropped_, 0);
  }

 private:
  static constexpr WallNs kSecond = 1'000'000'000;
  static constexpr int kGrantsPerSecond = 64;  // small ones, so that the reader has pauses
  static constexpr WallNs kGrantEvery = kSecond / kGrantsPerSecond;
  static constexpr std::size_t kGrant = kMaxLogBytesPerSecond / kGrantsPerSecond;

  void grant(WallNs moment) {
    const auto grants = static_cast<std::size_t>(moment - std::exchange(granted_at_, moment));
    left_ = std::min(kMaxLogBurst, left_ + std::min(grants, kMaxLogBurst / kGrant) * kGrant);
  }

  std::size_t left_ = kMaxLogBurst;
  WallNs granted_at_;   ///< in units of kGrantEvery
  WallNs reported_at_;  ///< in seconds
  std::uint64_t dropped_ = 0;
};

}  // namespace xr3
