#include "tools/report/class_report.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string_view>
#include <utility>

#include "protocol/goals/goal_text.hpp"
#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<link rel="icon" href="data:,">
<style>
  :root { color-scheme: light dark; font: 16px/1.45 system-ui, sans-serif; }
  body { max-width: 66rem; margin: 2rem auto; padding: 0 1rem; overflow-wrap: anywhere; }
  .scroll { overflow-x: auto; overflow-wrap: normal; }
  table { border-collapse: collapse; width: 100%; }
  th, td { text-align: left; padding: .3rem .6rem; vertical-align: top; }
  th, td { border-bottom: 1px solid #8886; }
  td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
  .met { color: #18794e; } .missed { color: #b3261e; }
  @media (prefers-color-scheme: dark) { .met { color: #6fd39a; } .missed { color: #ff8a80; } }
  h2 { margin-top: 2.5rem; border-top: 1px solid #8886; padding-top: 1rem; }
  .run { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 0 2rem; }
  @media (max-width: 50rem) { .run { grid-template-columns: minmax(0, 1fr); } }
  ul { list-style: none; margin: 0 0 1rem; padding: 0; } li { margin: .3rem 0; }
  img { width: 100%; min-height: 8rem; background: #fff; border: 1px solid #8886; }
  pre { overflow-x: auto; font-size: .6rem; line-height: 1.2; }
  .hint { opacity: .8; }
  @media print { section { break-inside: avoid; } }
</style>
)";

/// A name as a part of an address.
std::string address(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    std::array<char, 4> code{};
    std::snprintf(code.data(), code.size(), "%%%02X", static_cast<unsigned char>(c));
    result += is_plain ? std::string(1, c) : code.data();
  }
  return result;
}

std::string tag(const char* name, const std::string& inside, const char* kind = nullptr) {
  const std::string begin = std::string("<") + name;
  return begin + (kind != nullptr ? std::string(" class=\"") + kind + "\"" : "") + ">" + inside +
         "</" + name + ">";
}

std::string column(const char* name, const char* kind = "t") {
  return std::string("<th scope=\"col\" class=\"") + kind + "\">" + name + "</th>";
}

const char* kind_of(bool is_met) { return is_met ? "met" : "missed"; }

std::string score(const RunReport& report) {
  return std::to_string(points_of(report.goals)) + "/" +
         std::to_string(max_points_of(report.goals));
}

/// `2 of 9 goals missed`, or the reason why the run was not judged.
std::string verdict_of(const RunReport& report) {
  if (report.is_passed()) return "all goals met";
  if (!report.why.empty()) return html(report.why);
  const auto missed = std::ranges::count(report.goals, false, &GoalResult::is_met);
  if (missed == 0) return "goals not counted";
  return std::to_string(missed) + " of " + std::to_string(report.goals.size()) + " goals missed";
}

/// A link to the section of a submission.
std::string section_link(const std::string& name) {
  return "<a href=\"#" + address(name) + "\">" + html(name) + "</a>";
}

std::string twin_of(const Submission& submission) {
  if (submission.twin.empty()) return "";
  return "same bytes at the same simulated times as " + section_link(submission.twin);
}

std::string row(const Submission& submission) {
  const RunReport& report = submission.counted();
  const std::string twin = twin_of(submission);
  return tag("tr", tag("td", section_link(submission.name())) + tag("td", score(report), "n") +
                       tag("td", tag("span", verdict_of(report), kind_of(report.is_passed())) +
                                     (twin.empty() ? "" : "<br>" + tag("span", twin, "hint"))) +
                       tag("td", seconds_text(report.ticks), "n") +
                       tag("td", std::to_string(report.bytes), "n")) +
         "\n";
}

/// A table that is scrolled where the window is narrow.
std::string table(const char* id, const std::string& head, const std::string& rows) {
  return std::string("<div class=\"scroll\" id=\"") + id + "\"><table>\n<thead>" + tag("tr", head) +
         "</thead>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n";
}

/// One sentence about the class. The mean is rounded to a tenth of a point.
std::string class_summary(const std::vector<RunReport>& reports, bool has_moodle) {
  int sum = 0;
  int most = 0;
  std::size_t passed = 0;
  const auto not_run = std::ranges::count(reports, RunOutcome::kNotRun, &RunReport::outcome);
  for (const RunReport& each : reports) {
    sum += points_of(each.goals);
    most = std::max(most, max_points_of(each.goals));
    passed += each.is_passed() ? 1 : 0;
  }
  constexpr int kTenths = 10;
  const int count = std::max(1, static_cast<int>(std::ssize(reports) - not_run));
  const int mean = (kTenths * sum + count / 2) / count;
  return tag("p", "Submissions: " + std::to_string(reports.size()) +
                      (not_run > 0 ? ", " + std::to_string(not_run) + " of them not run" : "") +
                      ". All goals met by " + std::to_string(passed) + ". On average " +
                      std::to_string(mean / kTenths) + "." + std::to_string(mean % kTenths) +
                      " of " + std::to_string(most) +
                      " points. <a href=\"grades.csv\">Table for a spreadsheet</a>" +
                      (has_moodle ? ", <a href=\"moodle.csv\">for Moodle</a>" : "")) +
         "\n";
}

/// A table with the number of submissions that got the points of each goal. A run that could not be
/// made has no goals.
std::string goal_table(const std::vector<RunReport>& reports) {
  const auto fullest = std::ranges::max_element(
      reports, {}, [](const RunReport& each) { return each.goals.size(); });
  if (fullest == reports.end() || fullest->goals.empty()) return "";
  std::string rows;
  for (std::size_t i = 0; i < fullest->goals.size(); ++i) {
    const auto met = std::ranges::count_if(reports, [i](const RunReport& each) {
      return i < each.goals.size() && each.goals[i].is_met && each.goals[i].is_counted;
    });
    rows +=
        tag("tr", tag("td", html(fullest->goals[i].expected)) +
                      tag("td", std::to_string(fullest->goals[i].points), "n") +
                      tag("td", std::to_string(met) + "/" + std::to_string(reports.size()), "n")) +
        "\n";
  }
  return tag("h2", "Goals") + "\n" +
         table("goals", column("goal") + column("points", "n") + column("met by", "n"), rows);
}

std::string goal_item(const GoalResult& goal) {
  const std::string points =
      std::to_string(goal.earned()) + "/" + std::to_string(goal.points) + " ";
  std::string text =
      tag("span", (goal.is_met ? "✓ " : "✗ ") + points + html(goal.expected), kind_of(goal.is_met));
  if (!goal.is_counted) text += " (not counted)";
  if (!goal.is_met) text += ": " + html(goal.found);
  if (!goal.is_met && !goal.hint.empty())
    text += "<br>" + tag("span", "Hint: " + html(goal.hint), "hint");
  return tag("li", text) + "\n";
}

std::string link(const std::string& folder, const char* file, const std::string& text) {
  return "<a href=\"" + folder + "/" + file + "\">" + text + "</a>";
}

/// The picture of the end, which links to a large one, and a view from above.
std::string picture(const RunReport& report, const std::string& folder) {
  const std::string image = "<img loading=\"lazy\" src=\"" + folder + "/end.svg\" alt=\"" +
                            html(report.program) + ": the robot and its workcell at the end\">";
  return tag("p", link(folder, "end.svg", image)) +
         (report.is_passed() || report.top_view.empty()
              ? ""
              : "\n<details><summary>from above</summary>" + tag("pre", html(report.top_view)) +
                    "</details>");
}

std::string links(const std::string& folder) {
  return link(folder, "output.txt", "what it printed") + " · " +
         link(folder, "transcript.txt", "what it sent and received") + " · " +
         link(folder, "recording.xr3rec", "recording") + " · " +
         link(folder, "result.txt", "result as text") + " · " +
         link(folder, "result.json", "as JSON") + " · ";
}

/// The folder with the files of a run, as a part of an address.
std::string folder_link(const RunReport& report) {
  return address(report.program) + (report.run > 0 ? "/" + folder_of_run(report.run) : "");
}

/// The points of each run, and which one counts.
std::string runs_text(const Submission& submission) {
  std::string text = "The worst of " + std::to_string(submission.runs.size()) + " runs counts: ";
  for (const RunReport& each : submission.runs) {
    if (&each != &submission.runs.front()) text += ", ";
    text += link(folder_link(each), "result.txt", "run " + std::to_string(each.run)) +
            (each.seed ? " (seed " + std::to_string(*each.seed) + ")" : "") + " " + score(each);
  }
  return text + ". Below is run " + std::to_string(submission.counted().run) + ".";
}

/// A run that was not made has no goals and no files.
std::string section(const Submission& submission) {
  const RunReport& report = submission.counted();
  const std::string id = address(submission.name());
  const std::string folder = folder_link(report);
  const bool has_files = !report.goals.empty();
  std::string text = "<section id=\"" + id + "\">\n" +
                     tag("h2", html(report.program) + " " + score(report)) +
                     "\n<div class=\"run\">\n<div>\n";
  if (!report.why.empty()) text += tag("p", html(report.why), "missed") + "\n";
  if (has_files && submission.runs.size() > 1) text += tag("p", runs_text(submission)) + "\n";
  if (submission.runs.size() == 1 && report.seed)
    text += tag("p", "Blocks of seed " + std::to_string(*report.seed) + ".") + "\n";
  if (!submission.twin.empty())
    text += tag("p", "It sent and received the " + twin_of(submission) + ".") + "\n";
  text += "<ul>\n";
  for (const GoalResult& each : report.goals) text += goal_item(each);
  text += "</ul>\n";
  if (!report.not_counted.empty())
    text += tag("p", "Not counted: " + html(report.not_counted) + ".") + "\n";
  return text + "<p>" + (has_files ? links(folder) : "") +
         "<a href=\"#submissions\">all submissions</a></p>\n</div>\n<div>" +
         (has_files ? picture(report, folder) : "") + "</div>\n</div>\n</section>\n";
}

}  // namespace

const RunReport& Submission::counted() const {
  return *std::ranges::min_element(runs, {}, [](const RunReport& each) {
    return std::pair(points_of(each.goals), each.is_passed());
  });
}

void mark_twins(std::vector<Submission>& submissions) {
  std::map<std::vector<std::string>, Submission*> firsts;  // by the digests of the runs
  for (Submission& each : submissions) {
    std::vector<std::string> digests;
    for (const RunReport& run : each.runs)
      digests.push_back(run.bytes > 0 ? run.transcript : std::string());
    if (std::ranges::count(digests, std::string()) > 0) continue;
    const auto [at, is_first] = firsts.try_emplace(digests, &each);
    if (is_first) continue;
    each.twin = at->second->name();
    if (at->second->twin.empty()) at->second->twin = each.name();
  }
}

std::string to_html(const ClassReport& report) {
  std::string rows;
  std::vector<RunReport> counted;
  for (const Submission& each : report.submissions) {
    rows += row(each);
    counted.push_back(each.counted());
  }
  const std::string title =
      html(report.title.empty() ? "Robot programs" : report.title) + ": results";
  std::string text = kHead + tag("title", title) + "\n" + tag("h1", title) + "\n" +
                     class_summary(counted, !to_moodle(report).empty()) +
                     table("submissions",
                           column("submission") + column("points", "n") + column("result") +
                               column("simulated s", "n") + column("bytes", "n"),
                           rows) +
                     goal_table(counted);
  for (const Submission& each : report.submissions) text += section(each);
  return text + "</html>\n";
}

}  // namespace xr3
