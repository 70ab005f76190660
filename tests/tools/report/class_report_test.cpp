// The report of a class: page and tables.
#include "tools/report/class_report.hpp"

#include <gtest/gtest.h>

#include <string_view>

#include "protocol/text/printable.hpp"
#include "tests/support/some_report.hpp"

namespace xr3 {
namespace {

using test::some_report;
using test::uncounted_report;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A class of submissions with one run each.
ClassReport class_of(const std::vector<RunReport>& reports) {
  ClassReport report;
  for (const RunReport& each : reports) report.submissions.push_back({{each}});
  return report;
}

std::string page_of(const std::vector<RunReport>& reports) { return to_html(class_of(reports)); }
std::string table_of(const std::vector<RunReport>& reports) { return to_csv(class_of(reports)); }

TEST(ClassReport, ALinkHasTheBytesOfTheName) {
  RunReport report = some_report();
  report.program = "Ren\xe9";
  const std::string page = page_of({report});
  EXPECT_NE(page.find(R"(<a href="#Ren%E9">Ren\xe9</a>)"), std::string::npos) << page;
  EXPECT_NE(page.find("src=\"Ren%E9/end.svg\""), std::string::npos);
}

TEST(ClassReport, ThePageEscapesNamesAndLinksToTheirFiles) {
  const std::string page = page_of({some_report()});
  EXPECT_EQ(page.find("<a> &"), std::string::npos);
  EXPECT_NE(page.find("src=\"pick%20%3Ca%3E%20%26%20%22b%22.py/end.svg\""), std::string::npos);
}

TEST(ClassReport, ThePageSumsUpTheClass) {
  RunReport passed = some_report();
  passed.program = "ada.py";
  passed.goals[1].is_met = true;
  RunReport crashed = some_report();
  crashed.program = "gita.py";
  crashed.outcome = RunOutcome::kFailed;
  crashed.why = "signal <11>";
  crashed.goals.clear();
  const std::string page = page_of({passed, some_report(), crashed});
  const auto has = [&page](const std::string& text) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  };
  has("Submissions: 3. All goals met by 1. On average 2.3 of 5 points.");
  has("<td><span class=\"missed\">1 of 2 goals missed</span></td>");
  has("<td><span class=\"missed\">signal &lt;11&gt;</span></td>");
  has("<td>the robot never stalls</td><td class=\"n\">2</td><td class=\"n\">2/3</td>");
  has("<td>block red at x 1 mm</td><td class=\"n\">3</td><td class=\"n\">1/3</td>");
  has("✗ 0/3 block red at x 1 mm</span>: it is at x 2 mm | y<br>");
  has("alt=\"ada.py: the robot and its workcell at the end\"");
  EXPECT_EQ(page.find("gita.py/"), std::string::npos) << "no links to files that are not there";
}

TEST(ClassReport, GoalsThatAreNotCountedGiveNoPoints) {
  const std::string page = page_of({uncounted_report()});
  for (const char* text : {"<span class=\"missed\">goals not counted</span>",
                           "✓ 0/2 the robot never stalls</span> (not counted)</li>",
                           "<p>Not counted: it did &lt;nothing&gt;.</p>", "0.0 of 2 points",
                           "<td class=\"n\">2</td><td class=\"n\">0/1</td>"})
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  EXPECT_TRUE(table_of({uncounted_report()})
                  .ends_with("finished,0,2,0,1.25,17,,,\"not counted: it did <nothing>\"\n"));
}

TEST(ClassReport, TheViewFromAboveIsThereIfAGoalIsMissed) {
  RunReport report = some_report();
  EXPECT_NE(page_of({report}).find("<pre>a view\n</pre>"), std::string::npos);
  report.goals.pop_back();
  EXPECT_EQ(page_of({report}).find("<pre>"), std::string::npos);
}

TEST(ClassReport, APageOfNoGoalsHasNoTableOfThem) {
  EXPECT_EQ(page_of({}).find("id=\"goals\""), std::string::npos);
  EXPECT_EQ(page_of({RunReport{}}).find("id=\"goals\""), std::string::npos);
}

TEST(ClassReport, TheTableHasAColumnForEachGoal) {
  RunReport report = some_report();
  report.seed = 7;
  RunReport crashed;
  crashed.program = "gita.py";
  crashed.outcome = RunOutcome::kNotRun;
  EXPECT_EQ(table_of({crashed, report}),
            "\xEF\xBB\xBFsubmission,outcome,points,max_points,\"1: the robot never stalls\","
            "\"2: block red at x 1 mm\",sim_seconds,bytes,seed,same_as,missed\n"
            "\"gita.py\",not_run,0,0,,,0,0,,,\"\"\n"
            "\"pick <a> & \"\"b\"\".py\",finished,2,5,2,0,1.25,17,7,,"
            "\"block red at x 1 mm: it is at x 2 mm | y\"\n");
}

TEST(ClassReport, ACellOfTheTableIsNoFormula) {
  RunReport report = some_report();
  report.program = "=1+1";
  EXPECT_NE(table_of({report}).find("\n\"'=1+1\",finished,"), std::string::npos);
}

TEST(ClassReport, TheReasonOfARunIsInPageAndTable) {
  RunReport report = some_report();
  report.why = "nothing was sent";
  EXPECT_NE(page_of({report}).find("<span class=\"missed\">nothing was sent</span>"),
            std::string::npos);
  EXPECT_NE(table_of({report}).find("\"nothing was sent; block red"), std::string::npos);
}

TEST(ClassReport, EveryFormIsPrintable) {
  RunReport report = some_report();
  report.program = "Ren\xe9\x1b\u202e_7_assignsubmission_file";
  report.why = report.program;
  report.goals[1].expected = "block \x1b\u202e\xef\xbf\xbf";
  report.goals[1].hint = "\u2028";
  const ClassReport its = class_of({report});
  for (const std::string& form :
       {to_html(its), to_csv(its).substr(kByteOrderMark.size()), to_moodle(its)})
    EXPECT_EQ(form, printable_lines(form));
}

TEST(ClassReport, TheTitleIsThatOfTheExercise) {
  EXPECT_NE(page_of({}).find("<h1>Robot programs: results</h1>"), std::string::npos);
  EXPECT_NE(to_html({"Pick & place", {}}).find("<title>Pick &amp; place: results</title>"),
            std::string::npos);
}

// --- Several runs.

/// Runs with these points of 5 each, of seeds 7, 8, ...
Submission submission_of(const std::vector<int>& points) {
  Submission submission;
  for (const int each : points) {
    RunReport report = some_report();
    report.program = "ada.py";
    report.run = submission.runs.size() + 1;
    report.seed = 6 + report.run;
    report.goals[0].is_met = each % 3 == 2;
    report.goals[1].is_met = each >= 3;
    submission.runs.push_back(report);
  }
  return submission;
}

TEST(ClassReport, TheWorstRunCounts) {
  EXPECT_EQ(submission_of({5, 2, 3, 2}).counted().run, 2U);
  EXPECT_EQ(submission_of({5, 5}).counted().run, 1U);
  Submission failed = submission_of({0, 0});
  failed.runs[1].outcome = RunOutcome::kFailed;
  EXPECT_EQ(failed.counted().run, 1U) << "neither has passed";
  for (GoalResult& each : failed.runs[0].goals) each.points = 0, each.is_met = true;
  EXPECT_EQ(failed.counted().run, 2U) << "of equal points the one that has not passed";
}

TEST(ClassReport, ThePageHasThePointsOfAllRunsAndTheFilesOfTheWorst) {
  const std::string page = to_html({"", {submission_of({5, 2})}});
  const auto has = [&page](const std::string& text) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  };
  has("The worst of 2 runs counts: <a href=\"ada.py/001/result.txt\">run 1</a> (seed 7) 5/5, "
      "<a href=\"ada.py/002/result.txt\">run 2</a> (seed 8) 2/5. Below is run 2.");
  has("src=\"ada.py/002/end.svg\"");
  has("<section id=\"ada.py\">");
  has("All goals met by 0. On average 2.0 of 5 points.");
}

// --- Equal submissions.

Submission sent(const std::string& name, const std::string& digest, std::uint64_t bytes = 17) {
  Submission submission{{some_report()}};
  submission.runs[0].program = name;
  submission.runs[0].transcript = digest;
  submission.runs[0].bytes = bytes;
  return submission;
}

TEST(ClassReport, EqualTranscriptsAreFlagged) {
  ClassReport report{"", {sent("ada.py", "1"), sent("ben.py", "2"), sent("eva.py", "1")}};
  mark_twins(report.submissions);
  EXPECT_EQ(report.submissions[0].twin, "eva.py") << "nobody knows which one was first";
  EXPECT_EQ(report.submissions[1].twin, "");
  EXPECT_EQ(report.submissions[2].twin, "ada.py");
  EXPECT_NE(to_html(report).find("same bytes at the same simulated times as <a href=\"#ada.py\">"),
            std::string::npos);
  EXPECT_NE(to_csv(report).find(",\"ada.py\",\"block red"), std::string::npos);
}

TEST(ClassReport, NothingSentAndNoTranscriptAreNotEqual) {
  std::vector<Submission> all{sent("a", "1", 0), sent("b", "1", 0), sent("c", ""), sent("d", "")};
  mark_twins(all);
  for (const Submission& each : all) EXPECT_EQ(each.twin, "") << each.name();
}

// --- Moodle.

TEST(ClassReport, TheWorksheetOfMoodleHasThePointsAndWhatTheStudentReads) {
  RunReport ada = some_report();
  ada.program = "Ada King_Byron_4711_assignsubmission_file";
  RunReport not_run;
  not_run.program = "Bob_4712_assignsubmission_file";
  not_run.outcome = RunOutcome::kNotRun;
  EXPECT_EQ(to_moodle(class_of({ada, not_run, some_report()})),
            "Identifier,\"Full name\",Grade,\"Maximum Grade\",\"Feedback comments\"\n"
            "\"Participant 4711\",\"Ada King_Byron\",2,5,\"✓ the robot never stalls<br>"
            "✗ block red at x 1 mm: it is at x 2 mm | y. Hint: look `again`<br>\"\n");
}

TEST(ClassReport, WithoutNamesOfMoodleThereIsNoWorksheet) {
  for (const char* name : {"ada.py", "_assignsubmission_file", "7_assignsubmission_file",
                           "Ada_x_assignsubmission_file", "Ada__assignsubmission_file"}) {
    RunReport report = some_report();
    report.program = name;
    EXPECT_EQ(to_moodle(class_of({report})), "") << name;
  }
}

}  // namespace
}  // namespace xr3
