// The report of a run of a program, and its forms: lines for a terminal, JUnit, JSON, Markdown,
// annotations of GitHub. All forms are UTF-8 and printable, see protocol/text/printable.hpp.
//
// The flow through the folder: the judge (cli/exec/run.hpp) runs a program, compares the end with
// the goals (protocol/goals/judge.hpp) and fills a RunReport. A run in a process of its own returns
// its report as JSON: to_json() writes it there, parse_report() reads it in the judge. For `xr3
// exec` the caller then prints to_text() (text.cpp) and writes the files that the options ask for:
// JSON and Markdown (files.cpp), JUnit for test reporters (junit.cpp), in which the program and
// each goal are a test, and annotations (github.cpp). For `xr3 grade` class_report.hpp makes one
// page and the tables from the reports of all submissions. Names and messages come from programs
// under test and from their authors, so every form escapes them: tools/text/markup.hpp for HTML and
// XML, printable_line() for a terminal. Nothing here opens a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "protocol/goals/judge.hpp"

namespace xr3 {

struct RunReport {
  std::string program;  ///< name of the program, for titles and links; not always UTF-8
  /// Number among several runs of this program, from 1; 0 if it is the only one.
  std::size_t run = 0;
  RunOutcome outcome = RunOutcome::kFinished;
  std::string why;  ///< the problem, for the student; empty if nothing but goals was missed
  std::vector<GoalResult> goals;  ///< goals, judged with any outcome
  std::string not_counted;        ///< the reason why some goals are not counted; empty if all are
  std::string errors;             ///< end of the program's standard error
  Tick ticks = 0;                 ///< simulated time from the start to rest
  double wall_s = 0;
  std::uint64_t bytes = 0;  ///< number sent by the program
  std::string transcript;   ///< digest; empty without the byte clock
  std::string difference;   ///< from an earlier run of the program; empty if there is none
  std::optional<std::uint64_t> seed;  ///< seed of a variation of the blocks
  bool has_control = false;           ///< whether the program could use the calls of the monitor
  std::string top_view;               ///< the end, in characters; shown if a block is elsewhere

  /// Whether the program ended well, met every goal, and gets the points of all.
  bool is_passed() const;
};

/// The stable name: `finished`, `failed`, `time_up` or `not_run`.
std::string name_of(RunOutcome outcome);

/// The name of the program, and the number of the run if there are several.
std::string title_of(const RunReport& report);

/// The folder of one of several runs, in that of its program: 001, 002, ... Precondition: `run` is
/// its number, from 1.
std::string folder_of_run(std::size_t run);

/// Lines for a terminal, each with a line feed.
std::string to_text(const RunReport& report);
/// A JSON object on one line, with the printable name of the program.
std::string to_json(const RunReport& report);
/// Parses the JSON that to_json() wrote. Precondition: the text is unchanged.
RunReport parse_report(const std::string& json);
/// A table with a line for each goal.
std::string to_markdown(const std::vector<RunReport>& reports);
/// A document for test reporters: a test suite for each run, with a test for the program and one
/// for each goal.
std::string to_junit(const std::vector<RunReport>& reports);
/// An error for each goal that is missed, and each other problem, as a workflow command of GitHub
/// Actions, one a line.
std::string to_github(const std::vector<RunReport>& reports);

}  // namespace xr3
