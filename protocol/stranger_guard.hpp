// Keeps browsers and TLS clients off the robot: a connection's first bytes are held while they are the
// beginning of an HTTP request line (method, blank, slash) or of a TLS hello. Completed, not one byte
// has acted; the first byte that differs lets them all act. Never later on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

enum class Verdict : std::uint8_t {
  kHold,      ///< still the beginning of a stranger's greeting
  kPass,      ///< a client: the held bytes act, and this one after them
  kStranger,  ///< close the connection
};

class StrangerGuard {
 public:
  /// Judges the next byte. After kPass every byte passes; after kStranger none does. A byte that is
  /// held is appended to held(); the one that passes or completes is not.
  Verdict take(std::uint8_t byte);

  /// The bytes held back so far, at most kMostHeld.
  std::string_view held() const { return held_; }
  /// Gives the held bytes away, for the caller to let them act.
  std::string release();

  static constexpr std::size_t kMostHeld = 8;  // "OPTIONS " or "CONNECT "

  bool operator==(const StrangerGuard&) const = default;

 private:
  std::string held_;
  Verdict verdict_ = Verdict::kHold;
};

}  // namespace xr3
