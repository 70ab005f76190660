// Findings in a data file as values: where, what was found, what is allowed. All errors are
// collected in one exception, so that a user can correct them together. Independent of JSON and of
// the files' meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace xr3 {

/// An error makes a file unusable; a warning does not.
enum class Severity : std::uint8_t { kError, kWarning };

/// One error or warning about a data file.
struct Finding {
  Severity severity = Severity::kError;
  std::string file;
  int line = 0;          ///< from 1
  int column = 0;        ///< from 1 for a syntax error; 0 otherwise
  std::string pointer;   ///< JSON pointer (RFC 6901); empty for the whole file
  std::string found;     ///< content of the file there; empty if it is missing
  std::string allowed;   ///< allowed content
  std::size_t more = 0;  ///< if not 0: the number of further findings, which are not listed
  bool operator==(const Finding&) const = default;
};

using Findings = std::vector<Finding>;

/// The maximum number of findings of one file that are listed. Of further ones only the number is.
inline constexpr std::size_t kMaxFindings = 100;

/// One line: `FILE:LINE: /pointer: found X; allowed: Y`, or `is missing` instead of `found X`;
/// warnings are marked as such.
std::string to_text(const Finding& finding);

/// One line per finding, each with a line feed.
std::string to_text(const Findings& findings);

bool has_errors(const Findings& findings);

/// Adds a finding, or counts it in a last one if there are kMaxFindings already.
void add_bounded(Findings& findings, Finding finding);

/// The first `most` bytes of a text, followed by three dots if it is longer. Never splits a UTF-8
/// character.
std::string cut(std::string_view text, std::size_t most);

/// Stable sort by line, errors and warnings mixed. The finding that counts others is last.
void sort_by_line(Findings& findings);

/// The result of reading a file: its value unless a finding is an error, and the findings, sorted
/// by line.
template <class V>
struct FileReading {
  std::optional<V> value;
  Findings findings;
};

/// Thrown for a data file that cannot be used; carries all its findings.
class DataError : public std::runtime_error {
 public:
  explicit DataError(Findings findings);
  const Findings& findings() const { return findings_; }

 private:
  Findings findings_;
};

/// The value of a file. Throws DataError with all findings if one of them is an error.
template <class V>
V value_of(FileReading<V> reading) {
  if (!reading.value) throw DataError(std::move(reading.findings));
  return *std::move(reading.value);
}

}  // namespace xr3
