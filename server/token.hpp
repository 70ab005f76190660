// The secret that calls on the monitor port need: where it comes from. It is read once, at the start,
// and is never an argument of the process nor in its log.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <variant>

namespace xr3 {

inline constexpr std::size_t kLeastTokenBytes = 16;
inline constexpr std::size_t kMostTokenBytes = 1024;

struct NoToken {};
struct TokenFile {
  std::string path;
};
/// What XR3_TOKEN holds.
struct TokenInEnvironment {};
/// Made for this run, and told to whoever started it.
struct FreshToken {};
using TokenSource = std::variant<NoToken, TokenFile, TokenInEnvironment, FreshToken>;

inline constexpr const char* kTokenVariable = "XR3_TOKEN";

/// No token where one was announced, or one that is none; the message says what to do, without it.
class TokenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether XR3_TOKEN holds anything: an empty one counts as not set.
bool is_token_in_environment();

/// The token, empty where there is none to be. A file's last line end is left out. Throws TokenError,
/// and FileError for a file that cannot be read.
std::string read_token(const TokenSource& source);

/// Whether the file's rights let others than its owner and group read it.
bool others_may_read(const std::string& path);

}  // namespace xr3
