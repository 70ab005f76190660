#include "server/options/token.hpp"

#include <nettle/base64.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

using RandomBytes = std::array<std::uint8_t, 24>;  // 192 bits, 32 characters in base64url

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

RandomBytes random_bytes() {
  RandomBytes bytes{};
  for (std::size_t done = 0; done < bytes.size();) {
    const ::ssize_t got = ::getrandom(bytes.data() + done, bytes.size() - done, 0);
    if (got < 0 && errno != EINTR)
      throw TokenError("cannot get random bytes for a token from the system");
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  return bytes;
}

/// RFC 4648, section 5, without padding.
std::string base64url(const RandomBytes& bytes) {
  static_assert(RandomBytes{}.size() % 3 == 0, "no padding");
  std::string text(BASE64_ENCODE_RAW_LENGTH(RandomBytes{}.size()), '\0');
  base64_encode_ctx context;
  base64url_encode_init(&context);
  base64_encode_update(&context, text.data(), bytes.size(), bytes.data());
  return text;
}

struct Reader {
  std::string operator()(const NoToken&) const { return {}; }
  std::string operator()(const TokenFile& file) const {
    std::string text = read_file(file.path).text;
    if (text.ends_with('\n')) text.pop_back();
    if (text.ends_with('\r')) text.pop_back();
    return checked_token(std::move(text), file.path);
  }
  std::string operator()(const TokenInEnvironment&) const {
    const char* value = std::getenv(kTokenVariable);
    return checked_token(value == nullptr ? "" : value, kTokenVariable);
  }
  std::string operator()(const FreshToken&) const { return base64url(random_bytes()); }
};

}  // namespace

bool is_token_in_environment() {
  const char* value = std::getenv(kTokenVariable);
  return value != nullptr && *value != '\0';
}

std::string checked_token(std::string token, const std::string& where) {
  if (token.size() < kMinTokenBytes || token.size() > kMaxTokenBytes) {
    throw TokenError(where + ": a token has 16 to 1024 bytes; this one has " +
                     std::to_string(token.size()));
  }
  if (std::any_of(token.begin(), token.end(), is_control))
    throw TokenError(where + ": a token is one line of text without control characters");
  return token;
}

std::string read_token(const TokenSource& source) { return std::visit(Reader{}, source); }

bool others_may_read(const std::string& path) {
  std::error_code error;
  const auto rights = std::filesystem::status(path, error).permissions();
  return !error && (rights & std::filesystem::perms::others_read) != std::filesystem::perms::none;
}

}  // namespace xr3
