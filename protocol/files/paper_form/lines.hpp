// Splits a file in the paper's plain form (paper, Section III-A) into lines of data. Comment lines,
// which begin with `*`, are dropped, except those that begin with `*+`: these hold members of the
// JSON file that the paper's form lacks. Independent of robots and workcells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/finding.hpp"
#include "protocol/json/source.hpp"

namespace xr3::paper {

/// A member of a `*+` line, with the name and value that it has in the JSON file.
struct Addition {
  int line = 0;
  std::string key;
  Json value;
};

/// A line of numbers, with the additions between the previous data line and this one.
struct DataLine {
  int line = 0;
  std::vector<std::string> items;  ///< at least one
  std::vector<Addition> additions;
};

struct DataLines {
  std::vector<DataLine> data;
  std::vector<Addition> last;  ///< additions after the last data line
  int end = 1;                 ///< number of the last line
  Findings findings;           ///< additions that cannot be read
};

/// Splits a text. DataLines end with LF or CR LF; Ctrl-Z ends the text, as in DOS files.
DataLines split(std::string_view text, const std::string& file);

/// The item as a JSON number (an integer if possible), or as text if it is not a number.
Json number_or_text(const std::string& item);

}  // namespace xr3::paper
