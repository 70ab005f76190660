#include "protocol/json/finding.hpp"

#include <algorithm>
#include <utility>

#include "protocol/text/printable.hpp"

namespace xr3 {

namespace {

std::string sentence_of(const Finding& finding) {
  std::string text = finding.file + ":" + std::to_string(finding.line) + ":";
  if (finding.column > 0) text += std::to_string(finding.column) + ":";
  if (finding.severity == Severity::kWarning) text += " warning:";
  if (finding.more > 0) return text + " and " + std::to_string(finding.more) + " more like these";
  if (!finding.pointer.empty()) text += " " + finding.pointer + ":";
  text += finding.found.empty() ? " is missing" : " found " + finding.found;
  return text + "; allowed: " + finding.allowed;
}

}  // namespace

std::string to_text(const Finding& finding) { return printable_line(sentence_of(finding)); }

std::string to_text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) text += to_text(finding) + "\n";
  return text;
}

bool has_errors(const Findings& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::kError; });
}

void add_bounded(Findings& findings, Finding finding) {
  if (findings.size() < kMaxFindings) return findings.push_back(std::move(finding));
  if (findings.size() == kMaxFindings) {
    Finding rest;
    rest.severity = finding.severity;
    rest.file = finding.file;
    rest.line = finding.line;
    findings.push_back(std::move(rest));
  }
  Finding& rest = findings.back();
  rest.more += std::max<std::size_t>(finding.more, 1);
  if (finding.severity == Severity::kError) rest.severity = Severity::kError;
}

std::string cut(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (text[most] & 0xC0) == 0x80) --most;
  return std::string(text.substr(0, most)) + "...";
}

void sort_by_line(Findings& findings) {
  const auto is_before = [](const Finding& a, const Finding& b) {
    const bool a_is_rest = a.more > 0;
    const bool b_is_rest = b.more > 0;
    return a_is_rest == b_is_rest ? a.line < b.line : b_is_rest;
  };
  std::stable_sort(findings.begin(), findings.end(), is_before);
}

DataError::DataError(Findings findings)
    : std::runtime_error(to_text(findings)), findings_(std::move(findings)) {}

}  // namespace xr3
