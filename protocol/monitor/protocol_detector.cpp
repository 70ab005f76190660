#include "protocol/monitor/protocol_detector.hpp"

namespace xr3::monitor {
namespace {

using std::string_view_literals::operator""sv;

constexpr auto kOpeningBlanks = " \t\r\n"sv;
constexpr auto kByteOrderMark = "\xEF\xBB\xBF"sv;
constexpr char kTlsHandshake = 0x16;

bool is_blank(char byte) { return kOpeningBlanks.find(byte) != std::string_view::npos; }

}  // namespace

std::size_t ProtocolDetector::feed(std::string_view bytes) {
  std::size_t skipped = 0;
  while (skipped < bytes.size() && protocol_ == Protocol::kUndecided) {
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

void ProtocolDetector::decide(char byte) {
  if (byte == '{') {
    protocol_ = Protocol::kLines;
  } else if (only_lines_) {
    protocol_ = Protocol::kNotJson;
  } else if ('A' <= byte && byte <= 'Z') {
    protocol_ = Protocol::kHttp;
  } else {
    protocol_ = byte == kTlsHandshake ? Protocol::kTls : Protocol::kNotJson;
  }
}

}  // namespace xr3::monitor
