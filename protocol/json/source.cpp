#include "protocol/json/source.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/syntax.hpp"

namespace xr3 {
namespace {

bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '*';
}

}  // namespace

std::string without_comment_lines(std::string_view text) {
  std::string result(text);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (is_comment(text.substr(begin, end - begin))) {
      std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, ' ');
    }
    begin = end + 1;
  }
  return result;
}

std::string describe_duplicate(JsonValue member) {
  constexpr std::size_t kMaxLength = 200;
  return "\"" + cut(member.name().text(kMaxLength + 1), kMaxLength) + "\", a duplicate";
}

JsonSource::JsonSource(std::string_view text, std::string file)
    : file_(std::move(file)), text_(without_comment_lines(text)), document_(text_) {
  if (document_.fault() != JsonDocument::SyntaxFault::kNone)
    throw DataError({fault_finding(document_, file_)});
}

int JsonSource::line_of(JsonValue value) const {
  return place_of(document_.text(), value.offset()).line;
}

}  // namespace xr3
