// Builds the index of a JSON text; declared in document.hpp.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "protocol/json/document.hpp"

namespace xr3 {
namespace {

constexpr std::string_view kBetween = " \t\r\n,:";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The number of values and names of a JSON text; for other text, at most its size plus 1.
std::size_t count_tokens(std::string_view text) {
  std::size_t count = 1;
  bool was_open = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') i = text_end(text, i + 1);
    if (c == ',' || c == ':' || c == '{' || c == '[') ++count;
    if ((c == '}' || c == ']') && was_open) --count;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    was_open = c == '{' || c == '[';
  }
  return count;
}

/// The parser's message without the token that it quotes.
std::string without_token(std::string_view message) {
  constexpr std::size_t kMaxExpected = 64;
  const std::size_t quote = message.find("; last read: '");
  if (quote == std::string_view::npos) return std::string(message);
  std::string rest(message.substr(0, quote));
  const std::size_t expected = message.rfind("; expected ");
  if (expected != std::string_view::npos && message.size() - expected < kMaxExpected)
    rest += message.substr(expected);
  return rest;
}

/// Whether text is UTF-16: it begins with a byte order mark, or with a character whose other byte
/// is NUL, as all that may begin JSON.
bool is_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  return text.size() > 1 && (text[0] == '\0') != (text[1] == '\0');
}

}  // namespace

/// Builds the index: follows the parser's events and finds the position of each value and name.
class JsonIndexer : public nlohmann::json_sax<Json> {
 public:
  explicit JsonIndexer(JsonDocument& document) : document_(document) {}

  /// Fills the document's index, or sets its fault.
  void run() {
    const std::string_view text = document_.text_;
    if (is_utf16(text)) return complain(1, "UTF-16");
    const std::size_t nul = text.find('\0');  // the parser would treat it as the end
    if (nul != std::string_view::npos) return complain(nul + 1, "NUL byte");
    document_.tokens_.reserve(count_tokens(text));
    open_.reserve(JsonDocument::kMaxDepth);
    if (text.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    Json::sax_parse(text, this);
  }

  bool null() override { return word(); }
  bool boolean(bool) override { return word(); }
  bool number_integer(number_integer_t) override { return number(); }
  bool number_unsigned(number_unsigned_t) override { return number(); }
  bool number_float(number_float_t, const string_t&) override { return number(); }
  bool string(string_t&) override { return text(0); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t&) override { return text(JsonDocument::kIsName); }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override {
    complain(position, without_token(error.what()));
    document_.complaint_.token_size = last_token.size();
    return false;
  }

 private:
  void complain(std::size_t position, std::string message) {
    document_.fault_ = JsonDocument::SyntaxFault::kSyntax;
    document_.complaint_ = {position, 0, std::move(message), {}};
  }

  void find_next() {
    at_ = std::min(document_.text_.find_first_not_of(kBetween, at_), document_.text_.size());
  }

  bool word() {
    find_next();
    document_.tokens_.push_back({static_cast<std::uint32_t>(at_), 0});
    at_ += document_.text_[at_] == 'f' ? 5 : 4;
    return true;
  }

  bool number() {
    find_next();
    const std::string_view text = document_.text_;
    const std::size_t end = std::min(text.find_first_not_of("0123456789+-.eE", at_), text.size());
    document_.tokens_.push_back(
        {static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(end - at_)});
    at_ = end;
    return true;
  }

  bool text(std::uint32_t flags) {
    find_next();
    const std::size_t end = text_end(document_.text_, at_ + 1);
    const std::string_view written = document_.text_.substr(at_ + 1, end - at_ - 1);
    if (written.find('\\') != std::string_view::npos) flags |= JsonDocument::kHasEscapes;
    document_.tokens_.push_back(
        {static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(written.size()) | flags});
    at_ = end + 1;
    return true;
  }

  bool open() {
    find_next();
    if (open_.size() == JsonDocument::kMaxDepth) {
      document_.fault_ = JsonDocument::SyntaxFault::kTooDeep;
      document_.complaint_.position = at_ + 1;
      document_.complaint_.pointer =
          JsonValue(&document_, open_.back()).pointer_from(JsonValue(&document_, 0));
      return false;
    }
    open_.push_back(next_index());
    document_.tokens_.push_back({static_cast<std::uint32_t>(at_++), UINT32_MAX});
    return true;
  }

  bool close() {
    find_next();
    ++at_;
    document_.tokens_[open_.back()].rest = next_index();
    open_.pop_back();
    return true;
  }

  std::uint32_t next_index() const { return static_cast<std::uint32_t>(document_.tokens_.size()); }

  JsonDocument& document_;
  std::size_t at_ = 0;  ///< end of the last token
  std::vector<std::uint32_t> open_;
};

void JsonDocument::build_index() { JsonIndexer(*this).run(); }

}  // namespace xr3
