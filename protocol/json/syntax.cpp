#include "protocol/json/syntax.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "protocol/text/printable.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxQuotedLength = 40;

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '+' ||
         c == '-';
}

/// The quoted text that begins at an offset, up to the end of its line and kMaxQuotedLength bytes.
std::string quoted_at(std::string_view text, std::size_t offset) {
  const std::string_view rest = text.substr(offset, kMaxQuotedLength);
  const std::size_t end = rest.find_first_of("\"\n", 1);
  return std::string(end == std::string_view::npos ? rest : rest.substr(0, end + 1));
}

/// The word around an offset, the quoted text that begins there, or the single character.
std::string word_at(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the file";
  if (text[offset] == '"') return quoted_at(text, offset);
  std::size_t begin = offset;
  while (begin > 0 && is_word(text[begin]) && is_word(text[begin - 1])) --begin;
  std::size_t end = offset + 1;
  while (end < text.size() && is_word(text[offset]) && is_word(text[end])) ++end;
  return std::string(text.substr(begin, std::min(end - begin, kMaxQuotedLength)));
}

std::string allowed_here(const std::string& message) {
  if (contains(message, "; expected string literal")) return "a member name in double quotes";
  if (contains(message, "; expected ':'")) return "a colon after the member name";
  if (contains(message, "; expected '}'")) return "a comma or }";
  if (contains(message, "; expected ']'")) return "a comma or ]";
  if (contains(message, "; expected end of input")) return "nothing after the end of the value";
  return "a value: a number, \"text\", true, false, null, [ or {";
}

/// A part of the library's message about malformed text, with the finding that replaces it.
struct Phrase {
  std::string_view sign;
  std::string_view found;
  std::string_view allowed;
};

constexpr std::array<Phrase, 10> kPhrases = {{
    {"UTF-16", "UTF-16", "UTF-8"},
    {"NUL byte", "a NUL byte", "JSON in UTF-8"},
    {"number overflow", "a number that is too large", "numbers up to 1e308"},
    {"missing closing quote", "text without its closing quote", "text in double quotes"},
    {"control character", "a line end or control character inside text", "text on one line"},
    {"forbidden character after backslash", "an unknown escape after \\",
     "\\\" \\\\ \\/ \\b \\f \\n \\r \\t or \\uXXXX"},
    {"'\\u' must be followed", "an unfinished \\u escape", "\\u and four hex digits"},
    {"surrogate", "half of a surrogate pair", "both halves of the pair"},
    {"ill-formed UTF-8", "a byte that is not UTF-8", "text in UTF-8"},
    {"invalid number", "an unfinished number", "digits"},
}};

/// Sets what was found and what is allowed.
void describe_error(std::string_view text, std::size_t offset, const JsonDocument::Complaint& error,
                    Finding& finding) {
  for (const Phrase& phrase : kPhrases) {
    if (!contains(error.message, phrase.sign)) continue;
    finding.found = phrase.found;
    finding.allowed = phrase.allowed;
    return;
  }
  finding.found = printable_line(word_at(text, offset));  // which may split a character
  finding.allowed = allowed_here(error.message);
  const bool names_expected = contains(error.message, "; expected string literal");
  if (finding.found == "}" && names_expected) finding.found = "} after a comma";
}

/// The start of the word that contains an offset or ends there.
std::size_t word_start(std::string_view text, std::size_t offset) {
  if (offset >= text.size() || !is_word(text[offset])) {
    if (offset == 0 || !is_word(text[offset - 1])) return std::min(offset, text.size());
    --offset;
  }
  while (offset > 0 && is_word(text[offset - 1])) --offset;
  return offset;
}

/// Offset of the first character of the token that the parser refused.
std::size_t offset_of(std::string_view text, const JsonDocument::Complaint& error) {
  std::size_t offset = error.position > 0 ? error.position - 1 : 0;
  if (contains(error.message, "invalid literal")) return word_start(text, offset);
  const bool whole_token = contains(error.message, "unexpected string literal") ||
                           contains(error.message, "unexpected number literal");
  if (whole_token && error.token_size <= offset + 1) offset -= error.token_size - 1;
  return std::min(offset, text.size());
}

}  // namespace

Finding fault_finding(const JsonDocument& document, const std::string& file) {
  const std::string_view text = document.text();
  const JsonDocument::Complaint& complaint = document.complaint();
  Finding finding;
  finding.file = file;
  if (document.fault() == JsonDocument::SyntaxFault::kTooDeep) {
    finding.line = place_of(text, complaint.position - 1).line;
    finding.pointer = complaint.pointer;
    finding.found = "lists and objects deeper than " + std::to_string(JsonDocument::kMaxDepth);
    finding.allowed = "fewer";
    return finding;
  }
  const std::size_t offset = offset_of(text, complaint);
  const TextPlace place = place_of(text, offset);
  finding.line = place.line;
  finding.column = place.column;
  describe_error(text, offset, complaint, finding);
  return finding;
}

}  // namespace xr3
