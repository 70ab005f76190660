// Writes the paper's plain form from the JSON of a data file, with the same tables of rows as the
// reader.
#pragma once

#include <string>
#include <string_view>

#include "protocol/files/paper_form/reader.hpp"

namespace xr3::paper {

class PaperWriter {
 public:
  /// A comment line.
  void comment(std::string_view text);
  /// A `*+` line with the members that the part has; nothing if it has none.
  void extras(const Extras& extras, const Json& part);
  /// The row's title as a comment, then its line.
  void row(const DataRow& row, const Json& part);
  /// Only the line: for all rows of a table except the first.
  void line(const DataRow& row, const Json& part);
  /// The title as a comment, then a line with one number.
  void number(std::string_view title, std::size_t number);

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// The file name without folder and extension (`joint` for `folder/joint.txt`): the name of a robot
/// or workcell whose file gives none.
std::string stem_of(const std::string& file);

}  // namespace xr3::paper
