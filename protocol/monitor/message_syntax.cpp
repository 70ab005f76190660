#include "protocol/monitor/message_syntax.hpp"

#include <algorithm>
#include <string>

#include "protocol/json/syntax.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

/// Nesting depth of lists and objects.
int depth_of(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if (c == '}' || c == ']') --depth;
  }
  return deepest;
}

RequestError too_deep() {
  return {{},
          "too_deep",
          "lists and objects lie more than 32 deep",
          "no request needs more than 8",
          {}};
}

RequestError bad_json(std::size_t column, const std::string& what) {
  return {{},
          "bad_json",
          "line 1, column " + std::to_string(column) + ": " + what,
          "one JSON object a line",
          {}};
}

RequestError syntax_error(const JsonDocument& document) {
  const Finding finding = syntax_finding(document.text(), "", document.complaint());
  const std::string found =
      finding.found == "the end of the file" ? "the end of the message" : finding.found;
  return bad_json(static_cast<std::size_t>(finding.column),
                  found + "; allowed: " + finding.allowed);
}

}  // namespace

std::optional<RequestError> refuse_text(std::string_view message) {
  if (message.size() > kMaxMessageBytes) {
    return RequestError{
        {}, "too_long", "a message has at most 262144 bytes", "send less at once", {}};
  }
  if (depth_of(message) > kMaxDepth) return too_deep();
  const std::size_t nul = message.find('\0');  // the parser would treat it as the end
  if (nul != std::string_view::npos) return bad_json(nul + 1, "a NUL byte; allowed: JSON in UTF-8");
  return std::nullopt;
}

std::optional<RequestError> refuse_document(const JsonDocument& document) {
  if (document.fault() == JsonDocument::Fault::kTooDeep) return too_deep();
  if (document.fault() != JsonDocument::Fault::kNone) return syntax_error(document);
  if (!document.root().is_object()) return bad_json(1, "no object; allowed: {");
  return std::nullopt;
}

}  // namespace xr3::monitor
