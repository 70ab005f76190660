// The plain HTTP answers of the monitor port: is the server alive, is it ready? From the bytes of a
// request's head to the bytes of the answer, with the checks that keep other people's web pages
// out. No body is read, every connection ends with its answer. It knows no sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/http_guard.hpp"

namespace xr3::http {

inline constexpr std::size_t kMostHeadBytes = 16 * 1024;
inline constexpr std::size_t kMostTargetBytes = 8 * 1024;
inline constexpr std::size_t kMostFields = 64;

/// The head is whole, or more of it cannot mend what is wrong already.
bool is_head_decided(std::string_view received);

/// Whether the server takes work, as /readyz tells it.
enum class Readiness : std::uint8_t { kReady, kNotReady };

/// The whole answer to a head, or to as much of one as came.
std::string answer(std::string_view received, Readiness readiness);

}  // namespace xr3::http
