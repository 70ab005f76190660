#include "protocol/json/document.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

namespace xr3 {
namespace {

/// The first UTF-8 character boundary at or after `most` bytes, or the end of the text.
std::size_t letter_end(std::string_view text, std::size_t most) {
  std::size_t end = std::min(most, text.size());
  while (end < text.size() && (text[end] & 0xC0) == 0x80) ++end;
  return end;
}

unsigned hex_digits(std::string_view digits) {
  unsigned number = 0;
  std::from_chars(digits.data(), digits.data() + 4, number, 16);
  return number;
}

/// Decodes the contents of a quoted text piece by piece.
class StringDecoder {
 public:
  explicit StringDecoder(std::string_view written) : rest_(written) {}

  bool is_over() const { return rest_.empty(); }

  /// The bytes of the next escape sequence, or of the next part without escape sequences.
  std::string_view next() {
    if (rest_.front() == '\\') return escape();
    const std::size_t end = std::min(rest_.find('\\'), rest_.size());
    return take(end);
  }

 private:
  std::string_view take(std::size_t count) {
    const std::string_view part = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return part;
  }

  std::string_view escape() {
    constexpr std::string_view kLetters = "bfnrt";
    constexpr std::string_view kMeanings = "\b\f\n\r\t";
    const char letter = take(2)[1];
    if (letter == 'u') return utf8(code_point());
    const std::size_t found = kLetters.find(letter);
    bytes_[0] = found == std::string_view::npos ? letter : kMeanings[found];
    return {bytes_, 1};
  }

  unsigned code_point() {
    const unsigned first = hex_digits(take(4));
    if (first < 0xD800 || first > 0xDBFF) return first;
    const unsigned second = hex_digits(take(6).substr(2));
    return 0x10000 + ((first & 0x3FFU) << 10U) + (second & 0x3FFU);
  }

  std::string_view utf8(unsigned code) {
    std::size_t size = 0;
    const auto put = [&](unsigned byte) { bytes_[size++] = static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xC0U | (code >> 6U));
    } else if (code < 0x10000) {
      put(0xE0U | (code >> 12U));
      put(0x80U | ((code >> 6U) & 0x3FU));
    } else {
      put(0xF0U | (code >> 18U));
      put(0x80U | ((code >> 12U) & 0x3FU));
      put(0x80U | ((code >> 6U) & 0x3FU));
    }
    if (code >= 0x80) put(0x80U | (code & 0x3FU));
    return {bytes_, size};
  }

  std::string_view rest_;
  char bytes_[4] = {};
};

/// Size of a byte in dumped JSON.
std::size_t dumped_size(char c) {
  if (std::string_view("\"\\\b\f\n\r\t").find(c) != std::string_view::npos) return 2;
  return static_cast<unsigned char>(c) < 0x20 ? 6 : 1;
}

/// The member name of one part of a JSON pointer.
std::string unescaped(std::string_view part) {
  std::string name;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool is_escape = part[i] == '~' && i + 1 < part.size();
    name += !is_escape ? part[i] : part[++i] == '1' ? '/' : '~';
  }
  return name;
}

}  // namespace

std::size_t text_end(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return std::min(at, text.size());
}

TextPlace place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(offset - line_start)};
}

std::string child_pointer(const std::string& parent, std::string_view member) {
  std::string pointer = parent + "/";
  for (const char c : member) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
  return pointer;
}

std::string child_pointer(const std::string& parent, std::size_t element) {
  return parent + "/" + std::to_string(element);
}

// --- The document.

JsonDocument::JsonDocument(std::string_view text) : text_(text) {
  assert(text.size() <= kLength);
  build_index();
  if (fault_ == SyntaxFault::kNone) mark_duplicates();
}

JsonValue JsonDocument::root() const {
  return fault_ == SyntaxFault::kNone ? JsonValue(this, 0) : JsonValue();
}

void JsonDocument::mark_duplicates() {
  std::vector<std::uint32_t> names;
  for (std::uint32_t i = 0; i < tokens_.size(); ++i)
    if (text_[tokens_[i].begin] == '{') mark_duplicates(i, names);
}

void JsonDocument::mark_duplicates(std::uint32_t object, std::vector<std::uint32_t>& names) {
  names.clear();
  const JsonValue all(this, object);
  const std::size_t size = all.size();
  if (size < 2) return;
  names.reserve(size);
  for (const JsonValue member : all) names.push_back(member.index_ - 1);
  const auto compare = [this](std::uint32_t a, std::uint32_t b) {
    return JsonValue(this, a).compare_text(JsonValue(this, b));
  };
  std::sort(names.begin(), names.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int order = compare(a, b);
    return order != 0 ? order < 0 : a < b;
  });
  for (std::size_t i = 1; i < size; ++i)
    if (compare(names[i - 1], names[i]) == 0) tokens_[names[i]].rest |= kIsDuplicate;
}

// --- Scalars.

bool JsonValue::is_number() const {
  if (document_ == nullptr) return false;
  const char c = document_->text_[token().begin];
  return c == '-' || (c >= '0' && c <= '9');
}

std::string_view JsonValue::written() const {
  const Token& token = this->token();
  const std::string_view text = document_->text_;
  if (starts_with('"')) return text.substr(token.begin + 1, token.rest & JsonDocument::kLength);
  if (is_number()) return text.substr(token.begin, token.rest);
  return text.substr(token.begin, starts_with('f') ? 5 : 4);
}

// strtod depends on the locale, but xr3 never sets LC_NUMERIC.
double JsonValue::number() const { return std::strtod(std::string(written()).c_str(), nullptr); }

std::string JsonValue::text(std::size_t most) const {
  if (!has_escapes()) {
    const std::string_view all = written();
    return std::string(all.substr(0, letter_end(all, most)));
  }
  std::string result;
  for (StringDecoder letters(written()); !letters.is_over() && result.size() < most;) {
    const std::string_view part = letters.next();
    result += part.substr(0, letter_end(part, most - result.size()));
  }
  return result;
}

std::size_t JsonValue::text_size() const {
  if (!has_escapes()) return written().size();
  std::size_t size = 0;
  for (StringDecoder letters(written()); !letters.is_over();) size += letters.next().size();
  return size;
}

bool JsonValue::is(std::string_view text) const {
  if (!is_text()) return false;
  if (!has_escapes()) return written() == text;
  for (StringDecoder letters(written()); !letters.is_over();) {
    const std::string_view part = letters.next();
    if (!text.starts_with(part)) return false;
    text.remove_prefix(part.size());
  }
  return text.empty();
}

/// Compares two decoded texts by bytes: negative, 0 or positive.
int JsonValue::compare_text(JsonValue other) const {
  if (!has_escapes() && !other.has_escapes()) return written().compare(other.written());
  StringDecoder mine(written());
  StringDecoder others(other.written());
  std::string_view a;
  std::string_view b;
  for (;;) {
    if (a.empty() && !mine.is_over()) a = mine.next();
    if (b.empty() && !others.is_over()) b = others.next();
    if (a.empty() || b.empty()) return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
    const std::size_t common = std::min(a.size(), b.size());
    const int order = a.substr(0, common).compare(b.substr(0, common));
    if (order != 0) return order;
    a.remove_prefix(common);
    b.remove_prefix(common);
  }
}

// --- Lists and objects.

std::uint32_t JsonValue::next() const { return is_structured() ? token().rest : index_ + 1; }

JsonValue::Iterator& JsonValue::Iterator::operator++() {
  index_ = (**this).next();
  return *this;
}

JsonValue::Iterator JsonValue::begin() const {
  Iterator iterator;
  iterator.document_ = document_;
  iterator.index_ = index_ + 1;
  iterator.is_object_ = is_object();
  return iterator;
}

JsonValue::Iterator JsonValue::end() const {
  Iterator iterator = begin();
  iterator.index_ = next();
  return iterator;
}

std::size_t JsonValue::size() const {
  std::size_t size = 0;
  for (auto it = begin(); it != end(); ++it) ++size;
  return size;
}

JsonValue JsonValue::element(std::size_t index) const {
  for (const JsonValue each : *this)
    if (index-- == 0) return each;
  return {};
}

JsonValue JsonValue::find(std::string_view name) const {
  JsonValue found;
  if (!is_object()) return found;
  for (const JsonValue member : *this)
    if (member.name().is(name)) found = member;
  return found;
}

JsonValue JsonValue::name() const {
  if (document_ == nullptr || index_ == 0) return {};
  const JsonValue before(document_, index_ - 1);
  const bool is_name = before.is_text() && (before.token().rest & JsonDocument::kIsName) != 0;
  return is_name ? before : JsonValue();
}

bool JsonValue::is_repeated() const {
  const JsonValue name = this->name();
  return name && (name.token().rest & JsonDocument::kIsDuplicate) != 0;
}

// --- Position.

std::string JsonValue::pointer_from(JsonValue around) const {
  std::string pointer;
  while (around.index_ < index_ && pointer.size() < kMaxPointerLength) {
    std::size_t place = 0;
    JsonValue inner;
    for (const JsonValue each : around) {
      inner = each;
      if (index_ < each.next()) break;
      ++place;
    }
    const JsonValue name = inner.name();
    pointer =
        name ? child_pointer(pointer, name.text(kMaxPointerLength)) : child_pointer(pointer, place);
    around = inner;
  }
  return pointer;
}

/// The member or element at one part of a pointer, or empty.
JsonValue JsonValue::child(std::string_view part) const {
  if (is_object()) return find(unescaped(part));
  std::size_t place = 0;
  const auto read = std::from_chars(part.data(), part.data() + part.size(), place);
  const bool is_place = read.ec == std::errc() && read.ptr == part.data() + part.size();
  return is_list() && is_place ? element(place) : JsonValue();
}

JsonValue JsonValue::at(std::string_view pointer) const {
  JsonValue found = *this;
  while (found && !pointer.empty()) {
    const std::string_view part = pointer.substr(1, pointer.find('/', 1) - 1);
    pointer.remove_prefix(part.size() + 1);
    found = found.child(part);
  }
  return found;
}

JsonValue JsonValue::nearest(std::string_view pointer) const {
  for (;;) {
    if (const JsonValue found = at(pointer)) return found;
    pointer = pointer.substr(0, pointer.rfind('/'));
  }
}

std::size_t JsonValue::offset() const {
  const JsonValue name = this->name();
  return name ? name.token().begin : token().begin;
}

std::size_t JsonValue::extent() const {
  const auto& tokens = document_->tokens_;
  const std::size_t end = next() < tokens.size() ? tokens[next()].begin : document_->text_.size();
  return end - token().begin;
}

// --- Text form.

std::size_t JsonValue::json_size(std::size_t most) const {
  if (is_number()) {
    const std::string_view digits = written();
    const bool is_plain = digits.size() < 19 && digits != "-0" &&
                          digits.find_first_of(".eE") == std::string_view::npos;
    const bool is_float = digits.find_first_of(".eE") != std::string_view::npos;
    return is_plain ? digits.size() : (is_float ? Json(number()) : to_json()).dump().size();
  }
  if (is_text()) {
    std::size_t size = 2;
    for (StringDecoder letters(written()); !letters.is_over() && size <= most;)
      for (const char c : letters.next()) size += dumped_size(c);
    return size;
  }
  if (!is_structured()) return written().size();
  std::size_t size = 2;
  std::size_t members = 0;
  for (const JsonValue each : *this) {
    if (size > most) break;
    if (const JsonValue name = each.name()) size += name.json_size(most) + 1;
    size += each.json_size(most) + (members++ > 0 ? 1 : 0);
  }
  return size;
}

Json JsonValue::to_json() const {
  if (is_object()) {
    Json object = Json::object();
    for (const JsonValue member : *this) object[member.name().text()] = member.to_json();
    return object;
  }
  if (is_list()) {
    Json list = Json::array();
    for (const JsonValue element : *this) list.push_back(element.to_json());
    return list;
  }
  if (is_text()) return text();
  return Json::parse(written());
}

}  // namespace xr3
