#include "protocol/monitor/line_splitter.hpp"

#include <algorithm>

#include "protocol/monitor/request.hpp"

namespace xr3::monitor {
namespace {

constexpr std::string_view kLineBlanks = " \t\r\n";

std::string_view without_cr(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

void LineSplitter::feed(std::string_view bytes) {
  if (fault_ != LineFault::kNone) return;
  bytes_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  bytes_.append(bytes);
}

std::optional<std::string_view> LineSplitter::next() {
  if (fault_ != LineFault::kNone) return std::nullopt;
  skip_blanks();
  if (begin_ == bytes_.size()) return std::nullopt;
  if (bytes_[begin_] != '{') return fail(LineFault::kNotJson);
  const std::size_t found = bytes_.find('\n', scanned_);
  const bool is_whole = found != std::string::npos || has_ended_;
  const std::size_t end = std::min(found, bytes_.size());
  const std::string_view line = without_cr(std::string_view(bytes_).substr(begin_, end - begin_));
  if (line.size() > kMaxMessageBytes) return fail(LineFault::kTooLong);
  scanned_ = end;
  if (!is_whole) return std::nullopt;
  begin_ = end;  // skip_blanks() skips the line end
  return line;
}

void LineSplitter::skip_blanks() {
  begin_ = std::min(bytes_.find_first_not_of(kLineBlanks, begin_), bytes_.size());
  scanned_ = std::max(scanned_, begin_);
}

std::optional<std::string_view> LineSplitter::fail(LineFault fault) {
  fault_ = fault;
  bytes_.clear();
  bytes_.shrink_to_fit();
  begin_ = scanned_ = 0;
  return std::nullopt;
}

}  // namespace xr3::monitor
