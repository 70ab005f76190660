// Refuses connections to the robot port by the bytes that arrive first and together. It completes
// `HttpTlsDetector`, which then examines single bytes: a web page can choose some
// openings so that their first bytes are commands, such as the HTTP method `E+50`. A browser sends
// the head of a request at once, so the chunk that arrives first reveals it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace xr3 {

enum class Guard : std::uint8_t {
  kOff,     ///< refuse nothing, not even HTTP and TLS
  kNormal,  ///< refuse requests that a web page can make a browser send
  kStrict,  ///< refuse binary bytes as well, except those of telnet
};

/// The transport must pass this many bytes of a connection together, if they have arrived.
inline constexpr std::size_t kFirstChunk = 4096;

/// A chunk that begins with more characters of an HTTP method than this is taken for a request.
inline constexpr std::size_t kMaxMethod = 1024;

/// Whether a connection that begins with this chunk is no robot program. The caller must then close
/// it before any of the bytes is executed.
bool is_refused(std::string_view first_chunk, Guard guard);

}  // namespace xr3
