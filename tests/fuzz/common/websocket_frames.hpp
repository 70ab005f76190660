// A simple reader of WebSocket frames (RFC 6455) of either side, independent of Beast, to compare
// the server with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::fuzz {

enum class Opcode : std::uint8_t {
  kContinuation = 0,
  kText = 1,
  kBinary = 2,
  kClose = 8,
  kPing = 9,
  kPong = 10,
};

struct FrameHead {
  Opcode opcode{};
  bool is_final = false;
  bool is_masked = false;
  std::uint8_t reserved = 0;  ///< the bits RSV1...RSV3
  bool has_shortest_length = true;
  std::uint64_t length = 0;  ///< of the payload
  std::size_t size = 0;      ///< of the head
};
struct Frame : FrameHead {
  std::string payload;  ///< unmasked
};

/// Removes the first frame from the bytes; nullopt if it is incomplete.
std::optional<Frame> take_frame(std::string_view& bytes);

/// The status in the payload of a close frame; 1005 if there is none.
int close_code_of(std::string_view payload);

/// A server's reading of the bytes of a client.
struct ClientStream {
  enum class End : std::uint8_t {
    kOpen,     ///< the stream ends between or in frames
    kClosed,   ///< by a close frame or a mistake, with `close_code`
    kUnknown,  ///< a server may find a mistake in the incomplete last message, or not
  };
  std::vector<std::string> messages;  ///< the complete texts before the end
  std::vector<std::string> pings;     ///< the payloads before the end
  End end = End::kOpen;
  int close_code = 0;
};
ClientStream read_client_stream(std::string_view bytes);

}  // namespace xr3::fuzz
