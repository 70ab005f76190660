// Turns the lines of the paper's plain form into the JSON of the same data file, row by row as a table
// of rows asks for them, and remembers on which line each value stands: the JSON loader then judges the
// values, and its findings come back with the lines of the plain file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/paper_form_lines.hpp"

namespace xr3::paper {

/// One item of a row: where it goes in the JSON, relative to its part, and, where the form has a
/// number for a word, which.
struct Cell {
  std::string member;  ///< as "/limits/0"
  std::vector<std::pair<int, Json>>
      words{};            ///< numbers that stand for words; empty: taken as it is
  bool is_label = false;  ///< a letter
};

/// One line of data and the comment above it.
struct Row {
  std::string title;
  std::vector<Cell> cells;
  std::string member{};  ///< of the whole row, as "/limits"; a part itself if empty
};

/// A member of the JSON file that goes into a `*+` line: its name there, and where it goes.
struct Extra {
  std::string key;
  std::string member;
};
using Extras = std::vector<Extra>;

class Reader {
 public:
  Reader(std::string_view text, std::string file);

  /// From here on rows and `*+` lines belong to this part, until close().
  void open(const std::string& part, const Extras& extras);
  void close();

  /// Reads the next line into a part. False if it does not fit, or if reading has come to its end.
  bool row(const Row& row, const std::string& part);
  /// Reads a line with a number of parts and makes a list of so many, to be filled. Without a usable
  /// number reading comes to its end: what follows cannot be told apart. 0 then.
  std::size_t count(const std::string& title, const std::string& list, std::size_t most,
                    std::size_t least = 0);
  /// The same, the number being what row() put at `at`; it is taken out of the JSON again.
  std::size_t count_at(const std::string& at, const std::string& list, std::size_t most,
                       std::size_t least = 0);
  /// Reads a whole line of at least one item into a list.
  bool list(const std::string& title, const std::string& list);

  /// Whether lines are left.
  bool has_more() const { return !is_lost_ && next_ < lines_.data.size(); }
  /// The value read, or null.
  Json value(const std::string& pointer) const;
  void set(const std::string& pointer, Json value);
  /// Sets what no line has given.
  void set_default(const std::string& pointer, Json value);

  /// Reports what is left over.
  void finish();

  std::string json() const { return root_.dump(); }
  const std::string& file() const { return file_; }
  /// The JSON loader's findings, those of places that this reader has not refused already, at the lines
  /// of the plain file, together with its own; sorted.
  Findings merged(Findings of_loader) const;

 private:
  struct Part {
    std::string pointer;
    Extras extras;
  };

  const DataLine* next_line(const std::string& title, const std::string& pointer);
  bool fits(const Row& row, const DataLine& line) const;
  void misfit(const Row& row, const std::string& pointer, const DataLine& line);
  void put(const Cell& cell, const std::string& part, const std::string& item, int line);
  void take_additions(const std::vector<Addition>& additions);
  void take(const Addition& addition);
  void put(const Addition& addition, const Extra& extra, const std::string& part);
  void refuse_addition(const Addition& addition);
  void report(int line, const std::string& pointer, std::string found, std::string allowed);
  bool is_refused(const std::string& pointer) const;
  int line_of(std::string pointer) const;

  std::string file_;
  Lines lines_;
  std::size_t next_ = 0;
  bool is_lost_ = false;
  bool is_after_misfit_ = false;
  std::vector<Part> parts_;
  Json root_ = Json::object();
  std::map<std::string, int> line_of_;
  Findings findings_;
};

}  // namespace xr3::paper
