#include "protocol/files/paper_form/paper_form.hpp"

#include <utility>

#include "protocol/files/paper_form/lines.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kItemsOfAxes = 1;
constexpr std::size_t kItemsOfWorkspace = 3;

DataKind kind_of(const paper::DataLines& lines) {
  const std::size_t items = lines.data.empty() ? 0 : lines.data.front().items.size();
  if (items == kItemsOfAxes) return DataKind::kRobot;
  return items == kItemsOfWorkspace ? DataKind::kWorkcell : DataKind::kUnknown;
}

CheckResult unknown_result(const std::string& file, const paper::DataLines& lines) {
  CheckResult result;
  result.findings.push_back({Severity::kError, file,
                             lines.data.empty() ? lines.end : lines.data.front().line, 0, "",
                             lines.data.empty() ? "no numbers" : "neither a robot nor a workcell",
                             "a robot, which begins with its number of axes, or a workcell, which "
                             "begins with its workspace, X Y Z"});
  return result;
}

/// The first character outside comments, or a blank if there is none.
char first_character(std::string_view text) {
  const std::string data = without_comment_lines(text);
  const std::size_t first = data.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? ' ' : data[first];
}

bool is_json_file(std::string_view text, const std::string& file) {
  constexpr std::string_view kBeginsNumber = "0123456789+-.";
  if (is_json_form(text)) return true;
  return file.ends_with(".json") &&
         kBeginsNumber.find(first_character(text)) == std::string_view::npos;
}

/// The exception for a file with errors or of the other kind.
DataError unusable(const CheckResult& result, const std::string& file, const std::string& found,
                   const std::string& allowed) {
  if (!result.is_good()) return DataError(result.findings);
  return DataError({{Severity::kError, file, 1, 0, "", found, allowed}});
}

}  // namespace

bool is_json_form(std::string_view text) {
  constexpr std::string_view kBegins("{[\xFF\xFE\0", 5);
  return kBegins.find(first_character(text)) != std::string_view::npos;
}

CheckResult check_either_form(std::string_view text, const std::string& file, Profile profile,
                              const Robot* robot) {
  if (is_json_file(text, file)) return check_text(text, file, profile, robot);
  const paper::DataLines lines = paper::split(text, file);
  switch (kind_of(lines)) {
    case DataKind::kRobot: return robot_result(read_paper_robot(text, file), profile);
    case DataKind::kWorkcell: return workcell_result(read_paper_workcell(text, file, robot));
    default: return unknown_result(file, lines);
  }
}

Robot load_robot_of_either_form(std::string_view text, const std::string& file) {
  if (is_json_file(text, file)) return load_robot(text, file);
  CheckResult result = check_either_form(text, file, Profile::kPaper);
  if (!result.robot) throw unusable(result, file, "a workcell", "a robot");
  return *std::move(result.robot);
}

Workcell load_workcell_of_either_form(std::string_view text, const std::string& file) {
  if (is_json_file(text, file)) return load_workcell(text, file);
  CheckResult result = check_either_form(text, file, Profile::kPaper);
  if (!result.workcell) throw unusable(result, file, "a robot", "a workcell");
  return *std::move(result.workcell);
}

}  // namespace xr3
