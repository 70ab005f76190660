#include "protocol/monitor_tree.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "protocol/json_source.hpp"
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

/// Every character that stands outside texts.
template <class Look>
void for_each_outside_texts(std::string_view text, Look look) {
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (!in_text) look(c);
  }
}

/// How deep lists and objects lie inside one another.
int depth_of(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  for_each_outside_texts(text, [&](char c) {
    if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if (c == '}' || c == ']') --depth;
  });
  return deepest;
}

/// Members of all objects in a text that is JSON.
std::size_t members_in(std::string_view text) {
  std::size_t members = 0;
  for_each_outside_texts(text, [&](char c) { members += c == ':' ? 1 : 0; });
  return members;
}

std::size_t members_in(const Tree& tree) {
  std::size_t members = tree.is_object() ? tree.size() : 0;
  for (const Tree& value : tree) {
    if (value.is_structured()) members += members_in(value);
  }
  return members;
}

/// Follows the parser and tells of every name that its object has already.
class DuplicateListener : public nlohmann::json_sax<Tree> {
 public:
  using Tell = std::function<void(const std::string&, const std::string&)>;
  explicit DuplicateListener(const Tell& tell) : tell_(tell) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (!level.names.insert(name).second) tell_(child_pointer(level.pointer, name), name);
    level.member = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  static constexpr std::size_t kLongestPointer = 256;  ///< around the member: time is short

  struct Level {
    std::string pointer;
    bool is_list = false;
    std::size_t next_element = 0;
    std::string member;
    std::set<std::string> names;
  };

  /// The pointer of the value that comes now; in a list it moves on to the next element.
  std::string here() {
    if (levels_.empty()) return {};
    Level& level = levels_.back();
    return (level.is_list ? child_pointer(level.pointer, level.next_element++)
                          : child_pointer(level.pointer, level.member))
        .substr(0, kLongestPointer);
  }
  bool value() {
    if (!levels_.empty()) ++levels_.back().next_element;
    return true;
  }
  bool open(bool is_list) {
    levels_.push_back({here(), is_list, 0, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  const Tell& tell_;
  std::vector<Level> levels_;
};

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

void for_each_duplicate(
    std::string_view message, const Tree& tree,
    const std::function<void(const std::string& pointer, const std::string& name)>& tell) {
  if (members_in(message) == members_in(tree)) return;
  DuplicateListener listener(tell);
  Tree::sax_parse(message, &listener);
}

}  // namespace xr3::monitor
