// A file of the paper's plain form as lines of data: comment lines, which begin with `*`, are left out
// but for those that begin with `*+`, which carry members of the JSON file that the paper's form has
// no place for (paper, Section III-A). It knows no robot and no workcell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/finding.hpp"
#include "protocol/json_source.hpp"

namespace xr3::paper {

/// One member of a `*+` line, named and written as in the JSON file.
struct Addition {
  int line = 0;
  std::string key;
  Json value;
};

/// A line of numbers, with the additions between it and the data line before.
struct DataLine {
  int line = 0;
  std::vector<std::string> items;  ///< at least one
  std::vector<Addition> additions;
};

struct Lines {
  std::vector<DataLine> data;
  std::vector<Addition> last;  ///< additions after the last data line
  int end = 1;                 ///< number of the last line
  Findings findings;           ///< additions that cannot be read
};

/// Splits a text. Line ends may be LF or CR LF; a Ctrl-Z ends it, as in the files of DOS.
Lines split(std::string_view text, const std::string& file);

/// A number as JSON, or, if the item is none, the item as text. Whole numbers stay whole.
Json number_or_text(const std::string& item);

}  // namespace xr3::paper
