#include "protocol/json/source.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/syntax.hpp"

namespace xr3 {
namespace {

bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '*';
}

int line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<int>(std::count(text.begin(),
                                         text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

Finding fault_finding(const JsonDocument& document, const std::string& file) {
  const JsonDocument::Complaint& complaint = document.complaint();
  Finding finding{Severity::kError, file, 1, 0, complaint.pointer, {}, {}};
  switch (document.fault()) {
    case JsonDocument::Fault::kTooDeep:
      finding.line = line_at(document.text(), complaint.position - 1);
      finding.found = "lists and objects deeper than " + std::to_string(JsonDocument::kMaxDepth);
      finding.allowed = "fewer";
      return finding;
    case JsonDocument::Fault::kTooLong:
      finding.found = std::to_string(document.text().size()) + " bytes";
      finding.allowed = "up to " + std::to_string(JsonDocument::kMaxLength) + " bytes";
      return finding;
    default: return syntax_finding(document.text(), file, complaint);
  }
}

}  // namespace

std::string without_comment_lines(std::string_view text) {
  std::string result(text);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (is_comment(text.substr(begin, end - begin))) {
      std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, ' ');
    }
    begin = end + 1;
  }
  return result;
}

std::string describe_duplicate(JsonValue member) {
  constexpr std::size_t kMaxLength = 200;
  return "\"" + cut(member.name().text(kMaxLength + 1), kMaxLength) + "\", a duplicate";
}

JsonSource::JsonSource(std::string_view text, std::string file)
    : file_(std::move(file)), text_(without_comment_lines(text)), document_(text_) {
  if (document_.fault() != JsonDocument::Fault::kNone)
    throw DataError({fault_finding(document_, file_)});
}

int JsonSource::line_of(JsonValue value) const { return line_at(document_.text(), value.offset()); }

}  // namespace xr3
