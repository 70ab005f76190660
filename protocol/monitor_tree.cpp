#include "protocol/monitor_tree.hpp"

#include <algorithm>
#include <string>

#include "protocol/json_syntax.hpp"

namespace xr3::monitor {
namespace {

/// Listens to the parser for nothing but its complaint.
class ComplaintListener : public nlohmann::json_sax<Tree> {
 public:
  explicit ComplaintListener(std::string_view text) : text_(text) {}
  const Finding& finding() const { return finding_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_object() override { return true; }
  bool end_array() override { return true; }
  bool key(string_t&) override { return true; }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override {
    finding_ = syntax_finding(text_, "", {position, last_token, error.what()});
    return false;
  }

 private:
  std::string_view text_;
  Finding finding_;
};

/// How deep lists and objects lie inside one another; brackets inside texts do not count.
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

RequestError bad_json(std::size_t column, const std::string& what) {
  return {{},
          "bad_json",
          "line 1, column " + std::to_string(column) + ": " + what,
          "one JSON object a line",
          {}};
}

RequestError syntax_error(std::string_view message) {
  ComplaintListener listener(message);
  Tree::sax_parse(message, &listener);
  const Finding& finding = listener.finding();
  const std::string found =
      finding.found == "the end of the file" ? "the end of the message" : finding.found;
  return bad_json(static_cast<std::size_t>(finding.column),
                  found + "; allowed: " + finding.allowed);
}

}  // namespace

TreeReading read_tree(std::string_view message) {
  if (message.size() > kMostMessageBytes) {
    return RequestError{
        {}, "too_long", "a message has at most 262144 bytes", "send less at once", {}};
  }
  if (depth_of(message) > kDeepest) {
    return RequestError{{},
                        "too_deep",
                        "lists and objects lie more than 32 deep",
                        "no request needs more than 8",
                        {}};
  }
  const std::size_t nul = message.find('\0');  // the parser would take it for the end
  if (nul != std::string_view::npos) return bad_json(nul + 1, "a NUL byte; allowed: JSON in UTF-8");
  Tree tree = Tree::parse(message, nullptr, false);
  if (tree.is_discarded()) return syntax_error(message);
  if (!tree.is_object()) return bad_json(1, "no object; allowed: {");
  return tree;
}

}  // namespace xr3::monitor
