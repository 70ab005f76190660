// Writes the paper's plain form from the JSON of a data file, by the same tables of rows that the reader
// goes by.
#pragma once

#include <string>
#include <string_view>

#include "protocol/paper_form_reader.hpp"

namespace xr3::paper {

class Writer {
 public:
  /// A comment line.
  void comment(std::string_view words);
  /// A `*+` line with those members that the part has, or nothing.
  void extras(const Extras& extras, const Json& part);
  /// The row's title as a comment, then its line.
  void row(const Row& row, const Json& part);
  /// The line only: for all rows of a table but the first.
  void line(const Row& row, const Json& part);
  /// A title and a line of one number.
  void number(std::string_view title, std::size_t number);

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// `joint.txt` from `folder/joint.txt`, without folder and ending: what a file without a name is called.
std::string stem_of(const std::string& file);

}  // namespace xr3::paper
