#include "protocol/monitor/heading.hpp"

#include <algorithm>

#include "protocol/json/document.hpp"
#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/call_table.hpp"

namespace xr3::monitor {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kMaxNameLength = 16;              // "op" with every character escaped
constexpr std::size_t kMaxValue = 6 * kMaxIdBytes + 2;  // an id with every character escaped

/// Iterates over the outermost members of a text that may be invalid JSON.
class Skimmer {
 public:
  explicit Skimmer(std::string_view text) : text_(text), at_(text.find('{')) { pass(1); }

  /// Advances to the next member. Returns false if there is none.
  bool next() {
    at_ = text_.find_first_not_of(kBlanks, at_);
    if (at_ >= text_.size() || text_[at_] != '"') return false;
    const std::size_t begin = at_;
    pass_text();
    name_ = text_.substr(begin, at_ - begin);
    pass(std::min(text_.find_first_not_of(kBlanks, at_), text_.size()) - at_ + 1);  // the colon
    const std::size_t value = at_;
    pass_value();
    value_ = text_.substr(value, at_ - value);
    pass(1);  // the comma
    return true;
  }

  std::string_view name() const { return name_; }
  std::string_view value() const { return value_; }

 private:
  void pass(std::size_t count) {
    at_ = at_ < text_.size() ? std::min(at_ + count, text_.size()) : text_.size();
  }

  void pass_text() { at_ = std::min(text_end(text_, at_ + 1) + 1, text_.size()); }

  void pass_value() {
    for (int depth = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && (c == ',' || c == '}')) return;
      if (c == '"') at_ = text_end(text_, at_ + 1);
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
    }
    at_ = text_.size();
  }

  std::string_view text_;
  std::size_t at_;
  std::string_view name_;
  std::string_view value_;
};

bool is_name(std::string_view written, std::string_view name) {
  if (written.size() > kMaxNameLength) return false;
  if (written.find('\\') == std::string_view::npos)
    return written.size() == name.size() + 2 && written.substr(1, name.size()) == name;
  const JsonDocument document(written);
  return document.root().is(name);
}

/// The value if it is one of the names, otherwise empty.
std::string known(JsonValue value, const std::vector<std::string>& names) {
  return value.is_one_of(names) ? value.text() : "";
}

std::string_view op_of(const Request& request) {
  if (std::holds_alternative<CallRequest>(request.what)) return "call";
  if (std::holds_alternative<Subscribe>(request.what)) return "sub";
  if (std::holds_alternative<Get>(request.what)) return "get";
  return {};
}

}  // namespace

Heading heading_of(std::string_view message) {
  Heading heading;
  Skimmer members(message);
  while (members.next()) {
    if (members.value().size() > kMaxValue) continue;
    const bool is_op = is_name(members.name(), "op");
    const bool is_fn = is_name(members.name(), "fn");
    if (!is_op && !is_fn && !is_name(members.name(), "id")) continue;
    const JsonDocument value(members.value());
    if (is_op)
      heading.op = known(value.root(), ops());
    else if (is_fn)
      heading.fn = known(value.root(), calls());
    else
      heading.id = id_of(value.root()).value_or(RequestId());
  }
  return heading;
}

Heading heading_of(const Request& request) {
  const auto* wanted = std::get_if<CallRequest>(&request.what);
  return {request.id, std::string(op_of(request)), wanted == nullptr ? "" : wanted->fn};
}

}  // namespace xr3::monitor
