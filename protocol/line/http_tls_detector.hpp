// Detects clients that do not speak the robot protocol: browsers, TLS clients and WebRTC. The
// detector holds back the first bytes of a connection while they may begin an HTTP request line
// (RFC 9112, RFC 9113), a TLS hello, or STUN or TURN over TCP (RFC 8489, RFC 8656; with or without
// the frames of RFC 4571). If such an opening is complete, none of its bytes has been executed. At
// the first byte that differs, the held bytes are released for execution and detection ends.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/line/state_writer.hpp"

namespace xr3 {

enum class Detection : std::uint8_t {
  kUndecided,         ///< the bytes may still begin such an opening
  kPass,              ///< a robot program: execute the held bytes, then this one
  kNotARobotProgram,  ///< close the connection
};

class HttpTlsDetector {
 public:
  /// Examines the next byte. kPass and kNotARobotProgram are final. With kUndecided the byte is
  /// appended to held(); the byte that decides is not.
  Detection feed(std::uint8_t byte);

  /// Whether detection has ended with kPass before, so that feed() would hold no byte.
  bool has_passed() const { return detection_ == Detection::kPass && held_.empty(); }
  /// The held bytes, at most kMaxHeld.
  std::string_view held() const { return held_; }
  /// Removes and returns the held bytes; the caller must execute them.
  std::string release();

  static constexpr std::size_t kMaxHeld = 40;  // "CONNECT " and the host without port

  bool operator==(const HttpTlsDetector&) const = default;
  void write_state(StateWriter& out) const { out.add(held_, detection_); }

 private:
  std::string held_;
  Detection detection_ = Detection::kUndecided;
};

}  // namespace xr3
