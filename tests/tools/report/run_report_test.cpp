// The forms of the report of a run, and of a class.
#include "tools/report/run_report.hpp"

#include <gtest/gtest.h>

#include "protocol/text/printable.hpp"
#include "tools/report/class_report.hpp"

namespace xr3 {
namespace {

RunReport some_report() {
  RunReport report;
  report.program = "pick <a> & \"b\".py";
  report.goals = {
      {true, 2, "no_stall", "the robot never stalls", "", ""},
      {false, 3, "block", "block red at x 1 mm", "it is at x 2 mm | y", "look `again`"}};
  report.ticks = 1'250;
  report.bytes = 17;
  report.top_view = "a view\n";
  return report;
}

TEST(RunReport, LinesForPeople) {
  EXPECT_EQ(to_text(some_report()),
            "✓ the robot never stalls\n"
            "✗ block red at x 1 mm: it is at x 2 mm | y\n"
            "  hint: look `again`\n"
            "a view\n"
            "score 2 of 5; 1.25 simulated s, 17 bytes\n");
}

TEST(RunReport, SaysWhyARunFailedAndWhatElseMatters) {
  RunReport report = some_report();
  report.goals.pop_back();
  report.outcome = RunOutcome::kTimeUp;
  report.why = "time is up";
  report.seed = 9;
  report.has_control = true;
  EXPECT_EQ(
      to_text(report),
      "✗ time is up\n"
      "✓ the robot never stalls\n"
      "score 2 of 2; 1.25 simulated s, 17 bytes; blocks of seed 9; the program had control of "
      "the monitor port\n");
  EXPECT_FALSE(report.is_passed()) << "although all goals are met";
}

TEST(RunReport, SaysWhatAFinishedRunLacked) {
  RunReport report = some_report();
  report.why = "nothing was sent";
  EXPECT_TRUE(to_text(report).starts_with("✗ nothing was sent\n✓ the robot never stalls\n"));
  EXPECT_NE(to_markdown({report}).find("**nothing was sent**"), std::string::npos);
  EXPECT_NE(to_junit({report}).find("errors=\"1\""), std::string::npos);
  EXPECT_NE(to_html({report}).find("<td class=\"missed\">nothing was sent</td>"),
            std::string::npos);
  EXPECT_NE(to_csv({report}).find("\"nothing was sent; block red"), std::string::npos);
  report.goals.pop_back();
  EXPECT_TRUE(report.is_passed());
  EXPECT_NE(to_junit({report}).find("errors=\"0\""), std::string::npos);
}

/// A program that met a goal and gets no points for it.
RunReport uncounted_report() {
  RunReport report = some_report();
  report.goals.pop_back();
  report.goals.front().is_counted = false;
  report.not_counted = "it did <nothing>";
  return report;
}

TEST(RunReport, AGoalThatIsNotCountedIsMarked) {
  const RunReport report = uncounted_report();
  EXPECT_FALSE(report.is_passed());
  EXPECT_EQ(to_text(report),
            "✓ the robot never stalls (not counted)\n"
            "not counted: it did <nothing>\n"
            "score 0 of 2; 1.25 simulated s, 17 bytes\n");
  EXPECT_NE(to_markdown({report}).find("| ✓ | the robot never stalls | not counted | 0/2 |\n\n"
                                       "Not counted: it did \\<nothing>.\n"),
            std::string::npos)
      << to_markdown({report});
  const std::string junit = to_junit({report});
  EXPECT_NE(junit.find("failures=\"0\" errors=\"0\" skipped=\"1\""), std::string::npos) << junit;
  EXPECT_NE(junit.find("<skipped message=\"not counted\"/>"), std::string::npos) << junit;
}

TEST(RunReport, JsonIsReadBackAsItWas) {
  EXPECT_EQ(to_text(parse_report(to_json(uncounted_report()))), to_text(uncounted_report()));
  RunReport report = some_report();
  report.outcome = RunOutcome::kFailed;
  report.why = "exit code 3";
  report.seed = 18;
  report.run = 3;
  report.errors = "Traceback\n";
  report.transcript = "sha256:00";
  const std::string json = to_json(report);
  EXPECT_EQ(json.find('\n'), json.size() - 1) << "one line";
  const RunReport again = parse_report(json);
  EXPECT_EQ(to_json(again), json);
  EXPECT_EQ(to_text(again), to_text(report));
  EXPECT_NE(to_json(parse_report(to_json(RunReport{}))), json);
}

TEST(RunReport, JunitCountsAndEscapes) {
  const std::string text = to_junit({some_report()});
  EXPECT_NE(text.find("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"0\" time=\"1.25\""),
            std::string::npos);
  EXPECT_NE(text.find("pick &lt;a&gt; &amp; &quot;b&quot;.py"), std::string::npos);
  EXPECT_EQ(text.find("<a>"), std::string::npos);
}

TEST(RunReport, JunitNamesTheTestsOfARunAndOfEqualGoals) {
  RunReport report = some_report();
  report.goals.push_back(report.goals.front());
  report.run = 2;
  report.seed = 8;
  const std::string text = to_junit({report});
  const auto has = [&text](const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  };
  has("name=\"program, run 2\" time=\"1.25\"/>");
  has("name=\"the robot never stalls, run 2\"/>");
  has("name=\"the robot never stalls (2), run 2\"/>");
  has("<properties><property name=\"seed\" value=\"8\"/></properties>");
  EXPECT_EQ(to_junit({some_report()}).find("<properties>"), std::string::npos);
}

TEST(RunReport, MarkdownKeepsItsColumns) {
  const std::string text = to_markdown({some_report()});
  EXPECT_NE(text.find("| ✗ | block red at x 1 mm | it is at x 2 mm \\| y | 0/3 |"),
            std::string::npos)
      << text;
}

TEST(RunReport, EveryFormIsPrintable) {
  RunReport report = some_report();
  report.program = "Ren\xe9\x1b\u009b\u202e\u2028\xef\xbf\xbf";
  report.outcome = RunOutcome::kFailed;
  report.why = report.program + " cannot be started";
  report.goals[1].expected = "block \x1b\u202e\xef\xbf\xbf";
  report.goals[1].found = "it is on \x1b\u202e";
  report.goals[1].hint = "\u2028";
  report.top_view = "a \u009b\n";
  const std::string all[] = {to_text(report),    to_json(report),   to_markdown({report}),
                             to_junit({report}), to_html({report}), to_csv({report}),
                             to_github({report})};
  for (const std::string& form : all) EXPECT_EQ(form, printable_lines(form));
  const std::string name = R"(Ren\xe9\x1b\xc2\x9b\xe2\x80\xae\xe2\x80\xa8\xef\xbf\xbf)";
  EXPECT_EQ(parse_report(to_json(report)).program, name);
  EXPECT_EQ(parse_report(to_json(report)).goals[1].hint, "\u2028") << "JSON keeps its values";
  EXPECT_NE(to_junit({report}).find("<testsuite name=\"" + name), std::string::npos);
}

TEST(ClassReport, ALinkHasTheBytesOfTheName) {
  RunReport report = some_report();
  report.program = "Ren\xe9";
  const std::string page = to_html({report});
  EXPECT_NE(page.find(R"(<a href="#Ren%E9">Ren\xe9</a>)"), std::string::npos) << page;
  EXPECT_NE(page.find("src=\"Ren%E9/end.svg\""), std::string::npos);
}

TEST(ClassReport, ThePageEscapesNamesAndLinksToTheirFiles) {
  const std::string page = to_html({some_report()});
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
  const std::string page = to_html({passed, some_report(), crashed});
  const auto has = [&page](const std::string& text) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  };
  has("Submissions: 3. All goals met by 1. On average 2.3 of 5 points.");
  has("<td class=\"missed\">1 of 2 goals missed</td>");
  has("<td class=\"missed\">signal &lt;11&gt;</td>");
  has("<td>the robot never stalls</td><td class=\"n\">2</td><td class=\"n\">2/3</td>");
  has("<td>block red at x 1 mm</td><td class=\"n\">3</td><td class=\"n\">1/3</td>");
  has("✗ 0/3 block red at x 1 mm</span>: it is at x 2 mm | y<br>");
  has("alt=\"ada.py: the robot and its workcell at the end\"");
  EXPECT_EQ(page.find("gita.py/"), std::string::npos) << "no links to files that are not there";
}

TEST(ClassReport, GoalsThatAreNotCountedGiveNoPoints) {
  const std::string page = to_html({uncounted_report()});
  for (const char* text : {"<td class=\"missed\">goals not counted</td>",
                           "✓ 0/2 the robot never stalls</span> (not counted)</li>",
                           "<p>Not counted: it did &lt;nothing&gt;.</p>", "0.0 of 2 points",
                           "<td class=\"n\">2</td><td class=\"n\">0/1</td>"})
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  EXPECT_NE(
      to_csv({uncounted_report()}).find("finished,0,2,1.25,17,\"not counted: it did <nothing>\"\n"),
      std::string::npos);
}

TEST(ClassReport, TheViewFromAboveIsThereIfAGoalIsMissed) {
  RunReport report = some_report();
  EXPECT_NE(to_html({report}).find("<pre>a view\n</pre>"), std::string::npos);
  report.goals.pop_back();
  EXPECT_EQ(to_html({report}).find("<pre>"), std::string::npos);
}

TEST(ClassReport, APageOfNoGoalsHasNoTableOfThem) {
  EXPECT_EQ(to_html({}).find("id=\"goals\""), std::string::npos);
  EXPECT_EQ(to_html({RunReport{}}).find("id=\"goals\""), std::string::npos);
}

TEST(ClassReport, ACellOfTheTableIsNoFormula) {
  RunReport report = some_report();
  report.program = "=1+1";
  EXPECT_EQ(to_csv({report}),
            "submission,outcome,points,max_points,sim_seconds,bytes,missed\n"
            "\"'=1+1\",finished,2,5,1.25,17,\"block red at x 1 mm: it is at x 2 mm | y\"\n");
}

TEST(RunReport, AnnotationsOfGithubAreForProblemsOnly) {
  RunReport report = some_report();
  report.run = 2;
  report.goals.back().found = "100 %,\r\nor :: so";
  EXPECT_EQ(
      to_github({report}),
      "::error title=pick <a> & \"b\".py%2C run 2::block red at x 1 mm: 100 %25,\\x0d%0Aor :: "
      "so%0Ahint: look `again`\n");
  report.goals.clear();
  EXPECT_EQ(to_github({report}), "");
  report.program = "a:b";
  report.run = 0;
  report.why = "time is up";
  report.not_counted = "the program failed";
  EXPECT_EQ(
      to_github({report}),
      "::error title=a%3Ab::time is up\n::error title=a%3Ab::not counted: the program failed\n");
}

TEST(RunReport, ARunThatDiffersFromAnotherIsAProblemInEachForm) {
  RunReport report;
  report.program = "a.py";
  report.difference = "run 1 and run 2 differ first";
  EXPECT_NE(to_markdown({report}).find("**run 1 and run 2 differ first**"), std::string::npos);
  EXPECT_NE(to_junit({report}).find("<failure message=\"run 1 and run 2 differ first\"/>"),
            std::string::npos);
  EXPECT_EQ(to_github({report}), "::error title=a.py::run 1 and run 2 differ first\n");
  EXPECT_EQ(parse_report(to_json(report)).difference, report.difference);
}

}  // namespace
}  // namespace xr3
