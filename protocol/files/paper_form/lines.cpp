#include "protocol/files/paper_form/lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

namespace xr3::paper {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kAddition = "*+";
constexpr std::size_t kMaxShownLength = 40;
constexpr char kDosEnd = '\x1A';

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kBlanks) - begin + 1);
}

/// Whether a line is an addition: `*+` followed by a blank, a quote or nothing. A decorative row of
/// `+` is an ordinary comment.
bool is_addition(std::string_view line) {
  return line.starts_with(kAddition) && (line.size() == kAddition.size() || line[2] == '"' ||
                                         kBlanks.find(line[2]) != kBlanks.npos);
}

/// The text for messages: bytes other than printable ASCII are replaced, for files that are not
/// text.
std::string printable(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::vector<std::string> items_of(std::string_view line) {
  std::vector<std::string> items;
  while (!(line = trimmed(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    items.push_back(printable(line.substr(0, end)));
    line.remove_prefix(end);
  }
  return items;
}

/// Whether the value is a scalar or a list of scalars. No member of a `*+` line is nested deeper.
bool is_shallow(JsonValue value) {
  if (!value.is_list()) return !value.is_object();
  return std::none_of(value.begin(), value.end(),
                      [](JsonValue element) { return element.is_structured(); });
}

/// Collects the lines.
class Splitter {
 public:
  explicit Splitter(const std::string& file) : file_(file) {}

  void add_line(std::string_view line, int number) {
    result_.end = number;
    if (line.empty()) return;
    if (is_addition(line)) return add(line.substr(kAddition.size()), number);
    if (line.front() == '*') return;
    result_.data.push_back({number, items_of(line), std::move(pending_)});
    pending_.clear();
  }

  DataLines finish() {
    result_.last = std::move(pending_);
    return std::move(result_);
  }

 private:
  void add(std::string_view members, int number);
  void refuse(std::string_view members, int number);

  const std::string& file_;
  DataLines result_;
  std::vector<Addition> pending_;
};

void Splitter::add(std::string_view members, int number) try {
  const JsonSource source("{" + std::string(members) + "}", file_);
  const JsonValue root = source.root();
  if (!std::all_of(root.begin(), root.end(), is_shallow)) return refuse(members, number);
  for (const JsonValue member : root) {
    if (!member.is_repeated()) {
      pending_.push_back({number, member.name().text(), member.to_json()});
      continue;
    }
    add_bounded(result_.findings, {Severity::kError, file_, number, 0, member.pointer_from(root),
                                   describe_duplicate(member), "each member once"});
  }
} catch (const DataError&) {
  refuse(members, number);
}

void Splitter::refuse(std::string_view members, int number) {
  const bool is_long = members.size() > kMaxShownLength;
  add_bounded(result_.findings,
              {Severity::kError, file_, number, 0, "",
               "*+" + printable(members.substr(0, kMaxShownLength)) + (is_long ? "..." : ""),
               "members as in the JSON file, as in *+ \"name\": \"red\", \"color\": 12"});
}

}  // namespace

DataLines split(std::string_view text, const std::string& file) {
  text = text.substr(0, text.find(kDosEnd));
  Splitter splitter(file);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    splitter.add_line(trimmed(text.substr(0, end)), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return splitter.finish();
}

Json number_or_text(const std::string& item) {
  const char* begin = item.data() + (item.starts_with('+') ? 1 : 0);
  const char* end = item.data() + item.size();
  std::int64_t whole = 0;
  const auto as_whole = std::from_chars(begin, end, whole);
  if (as_whole.ec == std::errc{} && as_whole.ptr == end) return whole;
  const bool is_decimal = item.find_first_not_of("+-.0123456789eE") == std::string::npos;
  if (!is_decimal || begin == end || *begin == '+') return item;
  char* stop = nullptr;
  const double number = std::strtod(begin, &stop);
  if (stop == end && std::isfinite(number)) return number;
  return item;
}

}  // namespace xr3::paper
