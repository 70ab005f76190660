// Keeps clients that are no robot program off the robot: browsers, TLS clients and WebRTC. The guard
// holds a connection's first bytes while they could be the beginning of an HTTP request line (RFC
// 9112, RFC 9113), of a TLS hello, or of STUN or TURN over TCP (RFC 8489, RFC 8656; framed by
// RFC 4571 or not). If one completes, not one byte has acted; the first byte that differs lets them
// all act. After that the guard never looks again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

enum class Detection : std::uint8_t {
  kUndecided,         ///< still the beginning of a stranger's greeting
  kPass,              ///< a client: the held bytes act, and this one after them
  kNotARobotProgram,  ///< close the connection
};

class HttpTlsDetector {
 public:
  /// Judges the next byte. After kPass every byte passes; after kNotARobotProgram none does. A byte that is
  /// held is appended to held(); the one that passes or completes is not.
  Detection feed(std::uint8_t byte);

  /// The bytes held back so far, at most kMaxHeld.
  std::string_view held() const { return held_; }
  /// Gives the held bytes away, for the caller to let them act.
  std::string release();

  static constexpr std::size_t kMaxHeld = 40;  // "CONNECT " and the host before its port

  bool operator==(const HttpTlsDetector&) const = default;

 private:
  std::string held_;
  Detection detection_ = Detection::kUndecided;
};

}  // namespace xr3
