// The report for test reporters. Its form is that of the schema junit-10 of Jenkins' xunit plugin,
// which other services accept, too.
#include <algorithm>
#include <map>

#include "protocol/goals/goal_text.hpp"
#include "tools/report/run_report.hpp"
#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

struct JunitCase {
  std::string name;
  std::string problem = {};  ///< `failure`, `error` or `skipped`; empty if the test succeeds
  std::string message = {};
  std::string text = {};
  std::string errors = {};  ///< standard error of the program

  bool is_failed() const { return problem == "failure" || problem == "error"; }
};

JunitCase case_of(const RunReport& report) {
  if (report.why.empty() && !report.difference.empty())
    return {"program", "failure", report.difference};
  if (report.why.empty() || report.is_passed()) return {"program"};
  return {"program", report.outcome == RunOutcome::kNotRun ? "skipped" : "error", report.why};
}

/// Only a goal that gives points is a test that succeeds.
JunitCase case_of(const GoalResult& goal) {
  if (!goal.is_counted) return {goal.expected, "skipped", "not counted"};
  if (goal.is_met) return {goal.expected};
  return {goal.expected, "failure", goal.found, goal.hint};
}

/// The first problem gets the standard error of the program.
void add_errors(std::vector<JunitCase>& cases, const RunReport& report) {
  const auto first = std::ranges::find_if(cases, &JunitCase::is_failed);
  if (first != cases.end()) first->errors = report.errors;
}

/// The program and its goals as tests. A reporter compares tests with those of an earlier run by
/// their names, and keeps one of several equal names: so a name is the same in every run, and
/// unique.
std::vector<JunitCase> cases_of(const RunReport& report) {
  std::vector<JunitCase> cases{case_of(report)};
  for (const GoalResult& each : report.goals) cases.push_back(case_of(each));
  std::map<std::string, int> seen;
  for (JunitCase& each : cases) {
    const int number = ++seen[each.name];
    if (number > 1) each.name += " (" + std::to_string(number) + ")";
    if (report.run > 0) each.name += ", run " + std::to_string(report.run);
  }
  add_errors(cases, report);
  return cases;
}

std::string element(const JunitCase& test) {
  const std::string begin = "<" + test.problem + " message=\"" + xml(test.message) + "\"";
  const std::string end =
      test.text.empty() ? "/>" : ">" + html(test.text) + "</" + test.problem + ">";
  if (test.errors.empty()) return begin + end;
  return begin + end + "<system-err>" + html(test.errors) + "</system-err>";
}

std::string test_case(const std::string& program, const JunitCase& test, const std::string& time) {
  const std::string begin =
      "    <testcase classname=\"" + xml(program) + "\" name=\"" + xml(test.name) + "\"" + time;
  return test.problem.empty() ? begin + "/>\n" : begin + ">" + element(test) + "</testcase>\n";
}

/// An attribute with the number of tests that have a problem.
std::string count(const char* name, const std::vector<JunitCase>& cases, const char* problem) {
  return std::string(" ") + name + "=\"" +
         std::to_string(std::ranges::count(cases, problem, &JunitCase::problem)) + "\"";
}

/// A test suite for a run. Its time is that of the program; the goals are judged at the end.
std::string suite(const RunReport& report) {
  const std::vector<JunitCase> cases = cases_of(report);
  const std::string time = " time=\"" + seconds_text(report.ticks) + "\"";
  std::string text = "  <testsuite name=\"" + xml(title_of(report)) + "\" tests=\"" +
                     std::to_string(cases.size()) + "\"" + count("failures", cases, "failure") +
                     count("errors", cases, "error") + count("skipped", cases, "skipped") + time +
                     ">\n";
  if (report.seed)
    text += "    <properties><property name=\"seed\" value=\"" + std::to_string(*report.seed) +
            "\"/></properties>\n";
  for (const JunitCase& each : cases)
    text += test_case(report.program, each, &each == &cases.front() ? time : "");
  return text + "  </testsuite>\n";
}

}  // namespace

std::string to_junit(const std::vector<RunReport>& reports) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"xr3\">\n";
  for (const RunReport& each : reports) text += suite(each);
  return text + "</testsuites>\n";
}

}  // namespace xr3
