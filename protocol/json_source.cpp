#include "protocol/json_source.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "protocol/json_syntax.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kDeepest = 32;  ///< no data file needs more than six levels

/// Walks over the text for the parser and notes how far it has read.
struct ReadingIterator {
  // NOLINTBEGIN(readability-identifier-naming): std::iterator_traits asks for these
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  // NOLINTEND(readability-identifier-naming)

  const char* at;
  const char** furthest;

  reference operator*() const { return *at; }
  ReadingIterator& operator++() {
    *furthest = ++at;
    return *this;
  }
  bool operator==(const ReadingIterator& other) const { return at == other.at; }
};

/// Follows the parser's events and writes down the line of each value.
class LineWalker : public nlohmann::json_sax<Json> {
 public:
  LineWalker(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  const char** furthest() { return &furthest_; }
  std::map<std::string, int> take_lines() { return std::move(lines_); }
  Findings take_duplicates() { return std::move(duplicates_); }

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
  bool key(string_t& name) override;
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override;

 private:
  struct Level {
    std::string pointer;
    bool is_list = false;
    std::size_t next_element = 0;
    std::string member;
    std::set<std::string> names;
  };

  int line();
  std::string here();
  bool value();
  bool open(bool is_list);
  bool close();

  std::string_view text_;
  const std::string& file_;
  const char* furthest_ = nullptr;
  const char* counted_to_ = nullptr;
  int line_ = 1;
  std::vector<Level> levels_;
  std::map<std::string, int> lines_;
  Findings duplicates_;
};

// The character read last ends a token or, after a number, follows it: it does not count.
int LineWalker::line() {
  if (furthest_ == nullptr) return line_;
  if (counted_to_ == nullptr) counted_to_ = text_.data();
  const char* last = furthest_ - 1;
  if (last > counted_to_) {
    line_ += static_cast<int>(std::count(counted_to_, last, '\n'));
    counted_to_ = last;
  }
  return line_;
}

/// The pointer of the value that comes now; in a list it moves on to the next element.
std::string LineWalker::here() {
  if (levels_.empty()) return {};
  Level& level = levels_.back();
  if (level.is_list) return child_pointer(level.pointer, level.next_element++);
  return level.member;
}

bool LineWalker::value() {
  const std::string pointer = here();
  lines_.try_emplace(pointer, line());
  return true;
}

bool LineWalker::open(bool is_list) {
  if (levels_.size() >= kDeepest) {
    throw DataError({{Severity::kError, file_, line(), 0, levels_.back().pointer,
                      "lists and objects deeper than " + std::to_string(kDeepest), "fewer"}});
  }
  Level level;
  level.pointer = here();
  level.is_list = is_list;
  lines_.try_emplace(level.pointer, line());
  levels_.push_back(std::move(level));
  return true;
}

bool LineWalker::close() {
  levels_.pop_back();
  return true;
}

bool LineWalker::key(string_t& name) {
  Level& level = levels_.back();
  level.member = child_pointer(level.pointer, name);
  lines_[level.member] = line();
  if (!level.names.insert(name).second) {
    duplicates_.push_back({Severity::kError, file_, line(), 0, level.member,
                           "\"" + name + "\" for the second time", "each member once"});
  }
  return true;
}

bool LineWalker::parse_error(std::size_t position, const std::string& last_token,
                             const nlohmann::detail::exception& error) {
  throw DataError({syntax_finding(text_, file_, {position, last_token, error.what()})});
}

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

JsonSource::JsonSource(std::string_view text, std::string file) : file_(std::move(file)) {
  const std::string json = without_comment_lines(text);
  LineWalker walker(json, file_);
  const char* begin = json.data();
  Json::sax_parse(ReadingIterator{begin, walker.furthest()},
                  ReadingIterator{begin + json.size(), walker.furthest()}, &walker);
  lines_ = walker.take_lines();
  duplicates_ = walker.take_duplicates();
  root_ = Json::parse(json);
}

int JsonSource::line_of(std::string pointer) const {
  while (true) {
    const auto known = lines_.find(pointer);
    if (known != lines_.end()) return known->second;
    const std::size_t slash = pointer.rfind('/');
    if (slash == std::string::npos) return 1;
    pointer.resize(slash);
  }
}

}  // namespace xr3
