// Converts the lines of the paper's plain form to the JSON of the same data file, row by row
// according to a table of rows, and records the line of each value. The JSON loader then checks the
// values; its findings get the line numbers of the plain file.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/files/paper_form/lines.hpp"

namespace xr3::paper {

/// One item of a row: its place in the JSON, relative to its part, and the words that its numbers
/// stand for.
struct PaperCell {
  std::string member;  ///< such as "/limits/0"
  std::vector<std::pair<int, Json>>
      words{};            ///< numbers and the words they stand for; empty if it is a plain value
  bool is_label = false;  ///< a letter
};

/// One line of data and the comment above it.
struct DataRow {
  std::string title;
  std::vector<PaperCell> cells;
  std::string member{};  ///< member of the row, such as "/limits"; empty if it is the part itself
};

/// A member of the JSON file that is written in a `*+` line: its name there, and its place in the
/// JSON.
struct Extra {
  std::string key;
  std::string member;
};
using Extras = std::vector<Extra>;

class PaperReader {
 public:
  PaperReader(std::string_view text, std::string file);

  /// Until close(), rows and `*+` lines belong to this part. Parts may be nested.
  void open(const std::string& part, const Extras& extras);
  void close();

  /// Reads the next line into a part. Returns false if it does not fit or reading has ended.
  bool row(const DataRow& row, const std::string& part);
  /// Reads a line with a number of parts and makes a list with that many empty elements. Returns
  /// the number. Without a valid number it returns 0 and reading ends, as the rest cannot be
  /// interpreted.
  std::size_t count(const std::string& title, const std::string& list, std::size_t most,
                    std::size_t least = 0);
  /// Reads no line: takes the number that row() stored at `at`, which is removed from the JSON.
  /// Otherwise like count().
  std::size_t count_at(const std::string& at, const std::string& list, std::size_t most,
                       std::size_t least = 0);
  /// Reads a line of any number of items into a list.
  bool list(const std::string& title, const std::string& list);

  /// Whether lines are left.
  bool has_more() const { return !is_lost_ && next_ < lines_.data.size(); }
  /// The value read, or null.
  Json value(const std::string& pointer) const;
  void set(const std::string& pointer, Json value);
  /// Sets a value unless the file has it.
  void set_default(const std::string& pointer, Json value);

  /// Reports remaining lines as an error.
  void finish();

  std::string json() const { return root_.dump(); }
  const std::string& file() const { return file_; }
  /// The JSON loader's result with this reader's findings and the loader's, sorted. The loader's
  /// findings get the line numbers of the plain file; those about places that this reader has
  /// already refused are dropped.
  template <class V>
  FileReading<V> merged(FileReading<V> of_loader) const {
    of_loader.findings = merged(std::move(of_loader.findings));
    if (has_errors(of_loader.findings)) of_loader.value.reset();
    return of_loader;
  }

 private:
  struct Part {
    std::string pointer;
    Extras extras;
  };

  const DataLine* next_line(const std::string& title, const std::string& pointer);
  bool matches(const DataRow& row, const DataLine& line) const;
  void report_mismatch(const DataRow& row, const std::string& pointer, const DataLine& line);
  void put(const PaperCell& cell, const std::string& part, const std::string& item, int line);
  void apply_additions(const std::vector<Addition>& additions);
  void apply(const Addition& addition);
  void put(const Addition& addition, const Extra& extra, const std::string& part);
  void refuse_addition(const Addition& addition);
  void report(int line, const std::string& pointer, const std::string& found, std::string allowed);
  bool is_refused(const std::string& pointer) const;
  Findings merged(Findings of_loader) const;
  int line_of(std::string pointer) const;

  std::string file_;
  DataLines lines_;
  std::size_t next_ = 0;
  bool is_lost_ = false;
  bool is_after_mismatch_ = false;
  std::vector<Part> parts_;
  Json root_ = Json::object();
  std::map<std::string, int> line_of_;
  Findings findings_;
};

}  // namespace xr3::paper
