// A data file's text as JSON that remembers on which line every value stands and which members are
// given twice. Lines that begin with `*` are comments, as in the paper's data files (Section III-A).
// It knows nothing of what the members mean.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "protocol/finding.hpp"

namespace xr3 {

/// JSON whose members keep the order of the file.
using Json = nlohmann::ordered_json;

/// JSON text with comment lines blanked out, so that every offset and line stays what it was.
std::string without_comment_lines(std::string_view text);

/// `parent` followed by one more member name, escaped as RFC 6901 asks.
std::string child_pointer(const std::string& parent, std::string_view member);
std::string child_pointer(const std::string& parent, std::size_t element);

class JsonSource {
 public:
  /// Parses a whole file. Throws DataError with one finding (line, column) on a syntax error.
  JsonSource(std::string_view text, std::string file);

  const Json& root() const { return root_; }
  const std::string& file() const { return file_; }

  /// Line of the value (of a member: of its name) at a JSON pointer, or of the nearest one around it.
  int line_of(std::string pointer) const;

  /// One error for every member that is given more than once in its object.
  const Findings& duplicates() const { return duplicates_; }

 private:
  std::string file_;
  Json root_;
  std::map<std::string, int> lines_;
  Findings duplicates_;
};

}  // namespace xr3
