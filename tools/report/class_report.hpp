// The report about the submissions of a class: a page (class_report.cpp), and tables for a
// spreadsheet and for Moodle (class_tables.cpp).
#pragma once

#include <string>
#include <vector>

#include "tools/report/run_report.hpp"

namespace xr3 {

/// A submission and its runs, of which the worst counts.
struct Submission {
  std::vector<RunReport> runs;  ///< one at least
  /// Name of another submission with the same transcripts: the first, or for that one the next.
  /// Empty if there is none.
  std::string twin = {};

  const std::string& name() const { return runs.front().program; }

  /// The run with the fewest points; of several one that has not passed, else the first.
  const RunReport& counted() const;
};

struct ClassReport {
  std::string title;  ///< title of the exercise; empty if there is none
  std::vector<Submission> submissions;
};

/// Sets the twins. Submissions that sent nothing, or have no transcripts, have none.
void mark_twins(std::vector<Submission>& submissions);

/// A page with a table of all submissions, and for each its goals, the picture of the end and links
/// to its files, which are in the folder with its name beside the page.
std::string to_html(const ClassReport& report);

/// A line for each submission with name, outcome, points, maximum, the points of each goal,
/// simulated seconds, bytes, seed, twin, and the goals that were missed. It begins with a byte
/// order mark, by which spreadsheets recognise UTF-8.
std::string to_csv(const ClassReport& report);

/// The grading worksheet of a Moodle assignment, with points and feedback, for the submissions
/// whose names are those of Moodle's download; empty if there is none.
std::string to_moodle(const ClassReport& report);

}  // namespace xr3
