// The forms of the report of a run.
#include "tools/report/run_report.hpp"

#include <gtest/gtest.h>

#include "protocol/text/printable.hpp"
#include "tests/support/some_report.hpp"

namespace xr3 {
namespace {

using test::some_report;
using test::uncounted_report;

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
  report.goals.pop_back();
  EXPECT_TRUE(report.is_passed());
  EXPECT_NE(to_junit({report}).find("errors=\"0\""), std::string::npos);
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
  const std::string all[] = {to_text(report), to_json(report), to_markdown({report}),
                             to_junit({report}), to_github({report})};
  for (const std::string& form : all) EXPECT_EQ(form, printable_lines(form));
  const std::string name = R"(Ren\xe9\x1b\xc2\x9b\xe2\x80\xae\xe2\x80\xa8\xef\xbf\xbf)";
  EXPECT_EQ(parse_report(to_json(report)).program, name);
  EXPECT_EQ(parse_report(to_json(report)).goals[1].hint, "\u2028") << "JSON keeps its values";
  EXPECT_NE(to_junit({report}).find("<testsuite name=\"" + name), std::string::npos);
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
