// A data file's text as JSON that knows on which line every value stands and which members are given
// twice. Lines that begin with `*` are comments, as in the paper's data files (Section III-A).
// It knows nothing of what the members mean.
#pragma once

#include <string>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// JSON text with comment lines blanked out, so that every offset and line stays what it was.
std::string without_comment_lines(std::string_view text);

/// `parent` followed by one more member name, escaped as RFC 6901 asks.
std::string child_pointer(const std::string& parent, std::string_view member);
std::string child_pointer(const std::string& parent, std::size_t element);

/// `"name" for the second time`, of a member that its object has already.
std::string told_twice(JsonValue member);

class JsonSource {
 public:
  /// Parses a whole file. Throws DataError with one finding (line, column) on a syntax error.
  JsonSource(std::string_view text, std::string file);

  JsonValue root() const { return document_.root(); }
  const JsonDocument& document() const { return document_; }
  const std::string& file() const { return file_; }

  /// Line of the value, of a member that of its name. It counts from the beginning of the text.
  int line_of(JsonValue value) const;
  /// The same for the value at a JSON pointer, or the nearest one around it.
  int line_of(std::string_view pointer) const { return line_of(root().nearest(pointer)); }

 private:
  std::string file_;
  std::string text_;
  JsonDocument document_;
};

}  // namespace xr3
