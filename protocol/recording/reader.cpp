#include "protocol/recording/reader.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/syntax.hpp"
#include "protocol/recording/entry_json.hpp"

namespace xr3::recording {
namespace {

constexpr std::string_view kCheckMember = ",\"c\":\"";
constexpr std::string_view kLineEnd = "\"}";
constexpr std::size_t kCheckSize = kCheckMember.size() + RunningCheck::kSize + kLineEnd.size();

}  // namespace

void RecordingReader::add(std::string_view bytes) {
  text_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  text_ += bytes;
}

// A line that lacks only its line feed has been cut off there. Anything after it is a changed byte.
void RecordingReader::end() {
  has_ended_ = true;
  const std::string_view rest = std::string_view(text_).substr(begin_);
  const std::size_t close = rest.rfind(kLineEnd);
  const bool is_closed =
      close != std::string_view::npos && close >= kCheckSize - kLineEnd.size() &&
      rest.substr(close - RunningCheck::kSize - kCheckMember.size()).starts_with(kCheckMember);
  if (is_closed && close + kLineEnd.size() < rest.size())
    fail(line_ + 1, "other bytes at the end", "a line feed after each line");
}

std::optional<std::string_view> RecordingReader::next_line() {
  const std::size_t feed = text_.find('\n', searched_);
  const std::size_t length = std::min(feed, text_.size()) - begin_;
  if (length >= kMaxLine)
    fail(line_ + 1, "a longer line", "lines of at most " + std::to_string(kMaxLine) + " bytes");
  if (feed == std::string::npos) {
    searched_ = text_.size();
    return std::nullopt;
  }
  const std::string_view line = std::string_view(text_).substr(begin_, length);
  begin_ = searched_ = feed + 1;
  ++line_;
  return line;
}

void RecordingReader::check_line(std::string_view line) {
  const bool has_check = line.size() > kCheckSize && line.ends_with(kLineEnd) &&
                         line.substr(line.size() - kCheckSize).starts_with(kCheckMember);
  if (!has_check)
    fail(line_, "a line without a check at its end", "what xr3 serve --record writes");
  const std::size_t checked = line.size() - kLineEnd.size() - RunningCheck::kSize;
  check_.add(line.substr(0, checked));
  const std::string right = check_.text();
  if (line.substr(checked, RunningCheck::kSize) != right)
    fail(line_, "a line that was changed", "the recording as it was written");
  check_.add(line.substr(checked));
  check_.add("\n");
}

void RecordingReader::require_json(const JsonDocument& document) const {
  if (document.fault() == JsonDocument::SyntaxFault::kNone) return;
  Finding finding = fault_finding(document, file_);
  finding.line = static_cast<int>(line_);
  throw DataError({std::move(finding)});
}

std::optional<Header> RecordingReader::header() {
  const auto line = next_line();
  if (!line) return std::nullopt;
  const JsonDocument document(*line);
  const auto format = format_of(document.root());
  if (!format) fail(line_, "another first line", "a recording made by xr3 serve --record");
  if (*format != kFormat)
    fail(line_, "a recording of format " + std::to_string(*format),
         "format " + std::to_string(kFormat) + ", which this version of xr3 reads");
  check_line(*line);
  require_json(document);
  data::Reading reading(document.root(), data::Unit::kMm);
  auto header = read_header(reading);
  if (!header) fail(reading);
  return header;
}

std::optional<Entry> RecordingReader::next() {
  const auto line = next_line();
  if (!line) return std::nullopt;
  if (is_whole_) fail(line_, "a line after the end", "no line after the one with \"end\"");
  check_line(*line);
  const JsonDocument document(*line);
  require_json(document);
  data::Reading reading(document.root(), data::Unit::kMm);
  auto entry = read_entry(reading, epoch_);
  if (!entry) fail(reading);
  epoch_ = entry->epoch;
  is_whole_ = std::holds_alternative<End>(entry->body);
  return entry;
}

void RecordingReader::fail(std::int64_t line, const std::string& found,
                           const std::string& allowed) const {
  throw DataError({{Severity::kError, file_, static_cast<int>(line), 0, "", found, allowed}});
}

void RecordingReader::fail(data::Reading& reading) const {
  Findings findings = reading.take_findings();
  for (Finding& finding : findings) {
    finding.file = file_;
    finding.line = static_cast<int>(line_);
  }
  throw DataError(std::move(findings));
}

}  // namespace xr3::recording
