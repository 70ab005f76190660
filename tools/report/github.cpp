// The report as annotations of GitHub Actions: workflow commands, one a line.
#include <string_view>

#include "protocol/text/printable.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {
namespace {

/// A text with the characters escaped that end a command; those of `also` end a property.
std::string escaped_text(std::string_view text, std::string_view also = "") {
  std::string escaped;
  for (const char c : printable_lines(text)) {
    const bool is_escaped = c == '%' || c == '\n' || also.find(c) != also.npos;
    if (!is_escaped) {
      escaped += c;
      continue;
    }
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    escaped += {'%', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
  }
  return escaped;
}

std::string annotation(const RunReport& report, std::string_view message) {
  return "::error title=" + escaped_text(title_of(report), ":,") + "::" + escaped_text(message) +
         "\n";
}

std::string message_of(const GoalResult& goal) {
  return goal.expected + ": " + goal.found + (goal.hint.empty() ? "" : "\nhint: " + goal.hint);
}

}  // namespace

std::string to_github(const std::vector<RunReport>& reports) {
  std::string text;
  for (const RunReport& report : reports) {
    for (const std::string& each : {report.why, report.difference})
      if (!each.empty()) text += annotation(report, each);
    for (const GoalResult& each : report.goals)
      if (!each.is_met) text += annotation(report, message_of(each));
    if (!report.not_counted.empty())
      text += annotation(report, "not counted: " + report.not_counted);
  }
  return text;
}

}  // namespace xr3
