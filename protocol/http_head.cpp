#include "protocol/http_head.hpp"

#include <algorithm>
#include <optional>

#include "protocol/http_probe.hpp"

namespace xr3::http {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";

bool is_digit(char c) { return '0' <= c && c <= '9'; }
char lower(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_token_char(char c) {
  return is_digit(c) || ('a' <= lower(c) && lower(c) <= 'z') ||
         kMarks.find(c) != std::string_view::npos;
}
bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_token_char);
}
bool is_control(char c) { return (c >= 0 && c < ' ' && c != '\t') || c == '\x7f'; }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The next line without its end, taken off the front; nothing where it has no end yet.
std::optional<std::string_view> take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = text.substr(0, end + 1);
  text.remove_prefix(end + 1);
  return line;
}

bool has_proper_end(std::string_view line) { return line.ends_with(kLineEnd); }

HeadFault version_fault(std::string_view version) {
  if (version == "HTTP/1.1" || version == "HTTP/1.0") return HeadFault::kNone;
  const bool is_http = version.size() == 8 && version.starts_with("HTTP/") &&
                       is_digit(version[5]) && version[6] == '.' && is_digit(version[7]);
  return is_http ? HeadFault::kVersion : HeadFault::kMalformed;
}

HeadFault read_request_line(std::string_view line, Head& head) {
  if (std::any_of(line.begin(), line.end(), is_control)) return HeadFault::kMalformed;
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return HeadFault::kMalformed;
  head.method = line.substr(0, first);
  head.target = line.substr(first + 1, last - first - 1);
  if (!is_token(head.method) || head.target.find(' ') != std::string_view::npos)
    return HeadFault::kMalformed;
  if (head.target.empty()) return HeadFault::kMalformed;
  if (head.target.size() > kMostTargetBytes) return HeadFault::kTargetTooLong;
  return version_fault(line.substr(last + 1));
}

HeadFault read_field(std::string_view line, Head& head) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
    return HeadFault::kMalformed;
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (std::any_of(value.begin(), value.end(), is_control)) return HeadFault::kMalformed;
  if (head.fields.size() == kMostFields) return HeadFault::kTooLarge;
  head.fields.push_back({line.substr(0, colon), value});
  return HeadFault::kNone;
}

/// What to say of a line that does not end: it may still be on its way, or be too long already.
HeadFault unended(std::string_view line, bool is_first, bool is_cut) {
  if (!is_cut) return HeadFault::kIncomplete;
  const std::size_t target = is_first ? line.find(' ') : std::string_view::npos;
  const bool long_target =
      target != std::string_view::npos && line.size() - target > kMostTargetBytes;
  return long_target ? HeadFault::kTargetTooLong : HeadFault::kTooLarge;
}

HeadFault read_lines(std::string_view text, bool is_cut, Head& head) {
  for (bool is_first = true;; is_first = false) {
    const auto ended = take_line(text);
    if (!ended) return unended(text, is_first, is_cut);
    if (!has_proper_end(*ended)) return HeadFault::kMalformed;
    const std::string_view line = ended->substr(0, ended->size() - kLineEnd.size());
    if (line.empty() && !is_first) return HeadFault::kNone;
    const HeadFault fault = is_first ? read_request_line(line, head) : read_field(line, head);
    if (fault != HeadFault::kNone) return fault;
  }
}

}  // namespace

std::vector<std::string_view> Head::values(std::string_view name) const {
  std::vector<std::string_view> found;
  for (const Field& field : fields) {
    if (is_same_name(field.name, name)) found.push_back(field.value);
  }
  return found;
}

Head read_head(std::string_view received) {
  Head head;
  const bool is_cut = received.size() >= kMostHeadBytes;
  head.fault = read_lines(received.substr(0, kMostHeadBytes), is_cut, head);
  return head;
}

}  // namespace xr3::http
