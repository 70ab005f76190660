#include "protocol/monitor/opening.hpp"

namespace xr3::monitor {
namespace {

using std::string_view_literals::operator""sv;

constexpr auto kBlanks = " \t\r\n"sv;
constexpr auto kByteOrderMark = "\xEF\xBB\xBF"sv;
constexpr char kTlsHandshake = 0x16;

bool is_blank(char byte) { return kBlanks.find(byte) != std::string_view::npos; }

}  // namespace

std::size_t Opening::take(std::string_view bytes) {
  std::size_t skipped = 0;
  while (skipped < bytes.size() && tongue_ == Tongue::kUndecided) {
    const char byte = bytes[skipped];
    const bool inside_mark = mark_bytes_ % kByteOrderMark.size() != 0;
    if (mark_bytes_ < kByteOrderMark.size() && byte == kByteOrderMark[mark_bytes_]) {
      ++mark_bytes_;
    } else if (inside_mark || !is_blank(byte)) {
      decide(inside_mark ? '\0' : byte);
      continue;
    }
    ++skipped;
  }
  return skipped;
}

void Opening::decide(char byte) {
  if (byte == '{') {
    tongue_ = Tongue::kLines;
  } else if (only_lines_) {
    tongue_ = Tongue::kNotJson;
  } else if ('A' <= byte && byte <= 'Z') {
    tongue_ = Tongue::kHttp;
  } else {
    tongue_ = byte == kTlsHandshake ? Tongue::kTls : Tongue::kNotJson;
  }
}

}  // namespace xr3::monitor
