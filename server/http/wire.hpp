// HTTP/1 heads by Boost.Beast: parses request heads strictly (CR LF ends each line, no folded
// fields, bounded sizes and counts) and formats response heads. Only wire.cpp and
// server/monitor_port/websocket.cpp include Beast.
//
// The flow through the folder, which has no sockets and does not know the resources: the bytes of a
// request come from the session in server/resources. read_head() parses them into an HttpRequest,
// or says that the head is incomplete or at fault. refuse_head() (answer.hpp) turns a fault into
// its error response; otherwise the resource returns an Answer: status, type, fields and a Body
// (body.hpp), whose copies share their bytes. Pictures (pictures.hpp) makes the bodies of camera
// images, one for all clients, and compresses PNG in the worker. The session then formats the head
// of the response by head_text(), and sends head and body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::http {

inline constexpr std::size_t kMaxHeadBytes = 16 * 1024;
inline constexpr std::size_t kMaxTargetBytes = 8 * 1024;
inline constexpr std::size_t kMaxFields = 64;
/// The paths of WebSockets: a session of the monitor, a serial line, and a Foxglove client.
inline constexpr std::string_view kMonitorPath = "/ws";
inline constexpr std::string_view kLinePath = "/line";
inline constexpr std::string_view kFoxglovePath = "/foxglove";
/// The WebSocket subprotocols of a path; empty if it is no WebSocket's.
std::span<const std::string_view> subprotocols_of(std::string_view path);

/// Whether the connection stays open after a message.
enum class Then : std::uint8_t { kKeep, kClose };

struct Field {
  std::string name;   ///< as sent; compared case-insensitively
  std::string value;  ///< without surrounding blanks
};

struct HttpRequest {
  std::string method;
  std::string target;  ///< in origin form: path and query; absolute form is converted
  std::vector<Field> fields;
  Then then = Then::kClose;  ///< as requested; kClose if there is a body, which is not read
  bool is_upgrade = false;   ///< requests WebSocket, perhaps incompletely

  /// All values of a field, in order.
  std::vector<std::string_view> values(std::string_view name) const;
  /// The target without the query.
  std::string_view path() const;
  /// The first value of a query parameter, percent-decoded; empty if it cannot be decoded, nullopt
  /// if it is absent.
  std::optional<std::string> parameter(std::string_view name) const;
};

/// The subprotocol of a handshake: the first of its path that the client has offered, or the first
/// of all if it has offered none. Empty if it has offered others only.
std::string_view subprotocol_for(const HttpRequest& request);

/// The reason why a head is refused.
enum class HeadFault : std::uint8_t {
  kNone,
  kIncomplete,
  kMalformed,
  kVersion,  ///< HTTP, but not 1.0 or 1.1
  kTargetTooLong,
  kTooLarge,
};

struct HeadReading {
  HeadFault fault = HeadFault::kNone;
  HttpRequest request;         ///< valid if there is no fault
  std::size_t head_bytes = 0;  ///< size of the head; the bytes after it are not parsed
};

/// Parses the head at the start of the received bytes. kIncomplete: it may become valid with more.
HeadReading read_head(std::string_view received);

/// The head of a response, with the safety fields that `fields` lacks and the final empty line.
std::string head_text(unsigned status, const std::vector<Field>& fields, std::size_t body_bytes,
                      Then then);

/// The Content-Security-Policy of a page that pages of these origins alone may show in a frame. It
/// may compile WebAssembly (Python), and start workers from texts, which inherit it.
std::string page_policy(const std::vector<std::string>& frame_origins);

/// The security-related fields of every response.
const std::vector<Field>& safety_fields();

}  // namespace xr3::http
