// The token that calls on the monitor port require, and its sources. It is read once, at the start.
// It never appears in the arguments of the process or in the log.
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "server/base/exit_code.hpp"

namespace xr3 {

inline constexpr std::size_t kMinTokenBytes = 16;
inline constexpr std::size_t kMaxTokenBytes = 1024;

struct NoToken {};
struct TokenFile {
  std::string path;
};
/// The value of XR3_TOKEN.
struct TokenInEnvironment {};
/// Generated for this run and printed on standard error.
struct FreshToken {};
using TokenSource = std::variant<NoToken, TokenFile, TokenInEnvironment, FreshToken>;

inline constexpr const char* kTokenVariable = "XR3_TOKEN";

/// A missing or invalid token; the message never contains the token.
class TokenError : public ExitError {
 public:
  explicit TokenError(const std::string& what) : ExitError(ExitCode::kBadInput, what) {}
};

/// Whether XR3_TOKEN is set; an empty value counts as unset.
bool is_token_in_environment();

/// The token; empty for NoToken. The last line end of a file is removed. Throws TokenError, or
/// FileError if the file cannot be read.
std::string read_token(const TokenSource& source);

/// The token if it has the form of one. `where` is its source, for messages. Throws TokenError.
std::string checked_token(std::string token, const std::string& where);

/// Whether the file's permissions let users other than its owner and group read it.
bool others_may_read(const std::string& path);

}  // namespace xr3
