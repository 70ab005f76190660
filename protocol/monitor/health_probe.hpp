// A health check of a monitor port: the bytes to send, and the health after each received chunk of
// bytes. Independent of sockets; needs no token.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

class HealthProbe {
 public:
  /// The `hello` message of xr3, which announces the limit for later lines, is much shorter.
  static constexpr std::size_t kMaxLineBytes = 64 * 1024;

  /// kFull: the limit of monitor connections is reached; /readyz is answered all the same.
  enum class Health : std::uint8_t { kUnknown, kHealthy, kFull, kUnhealthy };

  /// The first byte to send: the server sends `hello` at once to a client that sends first. It
  /// selects JSON; if the peer is a serial line instead, it moves nothing.
  static std::string opening() { return "{"; }

  /// Handles received bytes, which may be anything. Returns the bytes to send now; may be empty.
  std::string feed(std::string_view bytes);

  Health health() const { return health_; }
  /// The problem so far, as the end of a sentence that begins with the server's address.
  std::string trouble() const;

 private:
  std::string handle_line();
  void refuse(std::string why);

  Health health_ = Health::kUnknown;
  bool is_greeted_ = false;
  std::string line_;  ///< the incomplete next message
  std::string why_;   ///< reason for kUnhealthy
};

/// The HTTP request for /readyz on the same port; `host` is the server's address and port.
std::string ready_request(const std::string& host);
/// The problem shown by the complete response, as the end of a sentence that begins with the
/// server's address; empty if the server is ready.
std::string trouble_with_readiness(std::string_view answer);

}  // namespace xr3
