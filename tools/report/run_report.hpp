// The report of a run of a program, and its forms: lines for a terminal, JUnit, JSON, Markdown. All
// forms are UTF-8 and printable, see protocol/text/printable.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "protocol/goals/judge.hpp"

namespace xr3 {

struct RunReport {
  std::string program;  ///< its name, for titles and links; not always UTF-8
  std::size_t run = 0;  ///< of several runs of this program, from 1; 0: it is the only one
  RunOutcome outcome = RunOutcome::kFinished;
  std::string why;                ///< what went wrong, for the student; empty: nothing but goals
  std::vector<GoalResult> goals;  ///< judged with any outcome
  std::string not_counted;        ///< why some goals are not counted; empty: all are
  std::string errors;             ///< the end of what the program wrote to standard error
  Tick ticks = 0;                 ///< simulated time from the start to rest
  double wall_s = 0;
  std::uint64_t bytes = 0;            ///< that the program sent
  std::string transcript;             ///< digest; empty without the byte clock
  std::optional<std::uint64_t> seed;  ///< of a variation of the blocks
  bool has_control = false;           ///< the program might use the calls of the monitor
  std::string top_view;               ///< of the end, in characters; shown if a block is elsewhere

  /// Whether the program ended well, met every goal, and gets the points of all.
  bool is_passed() const;
};

/// The stable name: `finished`, `failed`, `time_up` or `not_run`.
std::string name_of(RunOutcome outcome);

/// The name of the program, and which of several runs it is.
std::string title_of(const RunReport& report);

/// Lines for people, each with a line feed.
std::string to_text(const RunReport& report);
/// A JSON object on one line, with the printable name of the program.
std::string to_json(const RunReport& report);
/// Reads what to_json() wrote. Precondition: not changed since.
RunReport parse_report(const std::string& json);
/// A table with a line for each goal.
std::string to_markdown(const std::vector<RunReport>& reports);
/// A document for test reporters: a test suite for each run, with a test for the program and one
/// for each goal.
std::string to_junit(const std::vector<RunReport>& reports);

}  // namespace xr3
