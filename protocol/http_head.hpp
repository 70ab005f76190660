// The head of an HTTP/1 request, read strictly: CR LF ends each line, no folded fields, bounded in
// every direction. It knows no resources.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace xr3::http {

struct Field {
  std::string_view name;   ///< as sent; compared without regard to case
  std::string_view value;  ///< without blanks around it
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

/// Views into the bytes that were read.
struct Head {
  HeadFault fault = HeadFault::kNone;
  std::string_view method;
  std::string_view target;
  std::vector<Field> fields;

  /// Every value of a field, in order.
  std::vector<std::string_view> values(std::string_view name) const;
};

/// Reads a head from the front of what was received; what follows it is not looked at.
Head read_head(std::string_view received);

}  // namespace xr3::http
