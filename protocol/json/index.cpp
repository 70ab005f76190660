#include "protocol/json/index.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace xr3 {
namespace {

constexpr std::string_view kBetween = " \t\r\n,:";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kMaxOfMessage = 256;

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

/// The parser's message. A long one loses its middle, which quotes the token.
std::string shortened(std::string_view message) {
  if (message.size() <= 2 * kMaxOfMessage) return std::string(message);
  return std::string(message.substr(0, kMaxOfMessage))
      .append(message.substr(message.size() - kMaxOfMessage));
}

}  // namespace

void JsonIndexer::run() {
  const std::string_view text = document_.text_;
  document_.tokens_.reserve(count_tokens(text));
  open_.reserve(JsonDocument::kMaxDepth);
  if (text.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  const auto wrong = find_wrong_long_token(text);
  if (!wrong) {
    Json::sax_parse(text, this);
    return;
  }
  Json::sax_parse(text.substr(0, wrong->begin), this);
  const bool is_deep = document_.fault_ == JsonDocument::Fault::kTooDeep;
  const bool is_wrong = document_.fault_ == JsonDocument::Fault::kSyntax &&
                        document_.complaint_.position <= wrong->begin;
  if (!is_deep && !is_wrong) complain_of(*wrong);
}

/// Reports the parser's error for a short sample instead of the long token.
void JsonIndexer::complain_of(const LongToken& wrong) {
  const JsonDocument sample(wrong.sample);
  document_.fault_ = JsonDocument::Fault::kSyntax;
  document_.complaint_ = sample.complaint();
  document_.complaint_.position += wrong.offset;
}

void JsonIndexer::find_next() {
  at_ = std::min(document_.text_.find_first_not_of(kBetween, at_), document_.text_.size());
}

bool JsonIndexer::word() {
  find_next();
  document_.tokens_.push_back({static_cast<std::uint32_t>(at_), 0});
  at_ += document_.text_[at_] == 'f' ? 5 : 4;
  return true;
}

bool JsonIndexer::number() {
  find_next();
  const std::string_view text = document_.text_;
  const std::size_t end = std::min(text.find_first_not_of("0123456789+-.eE", at_), text.size());
  document_.tokens_.push_back(
      {static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(end - at_)});
  at_ = end;
  return true;
}

bool JsonIndexer::text(std::uint32_t flags) {
  find_next();
  const std::size_t end = text_end(document_.text_, at_ + 1);
  const std::string_view written = document_.text_.substr(at_ + 1, end - at_ - 1);
  if (written.find('\\') != std::string_view::npos) flags |= JsonDocument::kHasEscapes;
  document_.tokens_.push_back(
      {static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(written.size()) | flags});
  at_ = end + 1;
  return true;
}

bool JsonIndexer::open() {
  find_next();
  if (open_.size() == JsonDocument::kMaxDepth) {
    document_.fault_ = JsonDocument::Fault::kTooDeep;
    document_.complaint_.position = at_ + 1;
    document_.complaint_.pointer =
        JsonValue(&document_, open_.back()).pointer_from(JsonValue(&document_, 0));
    return false;
  }
  open_.push_back(next_index());
  document_.tokens_.push_back({static_cast<std::uint32_t>(at_++), UINT32_MAX});
  return true;
}

bool JsonIndexer::close() {
  find_next();
  ++at_;
  document_.tokens_[open_.back()].rest = next_index();
  open_.pop_back();
  return true;
}

bool JsonIndexer::parse_error(std::size_t position, const std::string& last_token,
                              const nlohmann::detail::exception& error) {
  document_.fault_ = JsonDocument::Fault::kSyntax;
  document_.complaint_ = {position, last_token.size(), shortened(error.what()), {}};
  return false;
}

}  // namespace xr3
