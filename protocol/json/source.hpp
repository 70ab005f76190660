// A data file's text as JSON, with the line of each value and the duplicate members. Lines that
// begin with `*` are comments, as in the paper's data files (Section III-A). Independent of the
// meaning of members.
#pragma once

#include <string>
#include <string_view>

#include "protocol/json/document.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// JSON text with comment lines replaced by blanks, so that offsets and lines do not change.
std::string without_comment_lines(std::string_view text);

/// `"name", a duplicate`, for a duplicate member.
std::string describe_duplicate(JsonValue member);

class JsonSource {
 public:
  /// Parses a file. On a syntax error throws DataError with one finding (line, column).
  JsonSource(std::string_view text, std::string file);

  JsonValue root() const { return document_.root(); }
  const JsonDocument& document() const { return document_; }
  const std::string& file() const { return file_; }

  /// Line of the value, from 1; for a member, that of its name. Takes time linear in the offset.
  int line_of(JsonValue value) const;
  /// Line of the value at a JSON pointer, or of the innermost existing value around it.
  int line_of(std::string_view pointer) const { return line_of(root().nearest(pointer)); }

 private:
  std::string file_;
  std::string text_;
  JsonDocument document_;
};

}  // namespace xr3
