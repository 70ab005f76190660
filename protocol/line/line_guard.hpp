// Refuses connections to the robot port by the bytes that arrive first and together. This is the
// second fence behind `HttpTlsDetector`, which examines single bytes: some openings can be chosen
// by a web page so that their first bytes are commands, such as the HTTP method `E+50`. A browser
// sends the head of a request at once, so the chunk that arrives first shows what it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace xr3 {

enum class Guard : std::uint8_t {
  kOff,     ///< refuse nothing, also not HTTP and TLS
  kNormal,  ///< refuse what a browser can be made to send
  kStrict,  ///< also refuse binary bytes, except those of telnet
};

/// The transport must pass this many bytes of a connection together, if they have arrived.
inline constexpr std::size_t kFirstChunk = 4096;

/// A chunk that begins with more characters of an HTTP method than this is taken for a request.
inline constexpr std::size_t kMaxMethod = 1024;

/// Whether a connection that begins with this chunk is no robot program. It must then be closed
/// before any of the bytes acts.
bool is_refused(std::string_view first_chunk, Guard guard);

}  // namespace xr3
