// HTTP/1 on the wire, by Boost.Beast: the head of a request from bytes, strictly (CR LF ends each
// line, no folded fields, bounded in every direction), and the head of an answer to bytes. It knows
// neither resources nor sockets; its .cpp is one of the two that see Beast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::http {

inline constexpr std::size_t kMostHeadBytes = 16 * 1024;
inline constexpr std::size_t kMostTargetBytes = 8 * 1024;
inline constexpr std::size_t kMostFields = 64;
/// The only one that /ws speaks.
inline constexpr std::string_view kSubprotocol = "xr3.v1";

/// What becomes of the connection behind a message.
enum class Then : std::uint8_t { kKeep, kClose };

struct Field {
  std::string name;   ///< as sent; compared without regard to case
  std::string value;  ///< without blanks around it
};

struct Request {
  std::string method;
  std::string target;
  std::vector<Field> fields;
  Then then = Then::kClose;  ///< what the client asks for; with a body, which nobody reads: kClose
  bool is_upgrade = false;   ///< it asks for WebSocket, whatever is missing for that

  /// Every value of a field, in order.
  std::vector<std::string_view> values(std::string_view name) const;
  /// The target up to its question mark.
  std::string_view path() const;
  /// The first value of a parameter behind the question mark, decoded, and empty where that cannot be;
  /// nothing where it is not given.
  std::optional<std::string> parameter(std::string_view name) const;
};

/// Why a head is refused, or that it is not.
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
  Request request;             ///< where there is no fault
  std::size_t head_bytes = 0;  ///< of it; what follows was not looked at
};

/// Reads a head from the front of what was received. kIncomplete: more of it may still mend it.
HeadReading read_head(std::string_view received);

/// The head of an answer, with the fields that keep browsers careful, and the empty line behind it.
std::string head_text(unsigned status, const std::vector<Field>& fields, std::size_t body_bytes,
                      Then then);

/// Those fields, for answers that are made elsewhere.
const std::vector<Field>& safety_fields();

}  // namespace xr3::http
