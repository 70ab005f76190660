// What was found in a data file, as values: where, what stands there, what may stand there. Errors
// are collected and carried by one exception, so that a user mends a file in one go. It knows nothing
// of JSON or of what the files mean.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace xr3 {

/// An error makes a file unusable; a warning only tells of something odd.
enum class Severity : std::uint8_t { kError, kWarning };

/// One thing wrong, or odd, in a data file.
struct Finding {
  Severity severity = Severity::kError;
  std::string file;
  int line = 0;         ///< from 1
  int column = 0;       ///< from 1 for a syntax error; 0 otherwise
  std::string pointer;  ///< JSON pointer (RFC 6901); empty for the whole file
  std::string found;    ///< what stands there
  std::string allowed;  ///< what may stand there
  bool operator==(const Finding&) const = default;
};

using Findings = std::vector<Finding>;

/// One line: `FILE:LINE: /pointer: found X; allowed: Y`, a warning marked as such.
std::string to_text(const Finding& finding);

/// One line each, every one ended by a line feed.
std::string to_text(const Findings& findings);

bool has_errors(const Findings& findings);

/// Sorts by line, errors and warnings mixed; findings of one line keep their order.
void sort_by_line(Findings& findings);

/// A data file that cannot be used, with every finding in it.
class DataError : public std::runtime_error {
 public:
  explicit DataError(Findings findings);
  const Findings& findings() const { return findings_; }

 private:
  Findings findings_;
};

}  // namespace xr3
