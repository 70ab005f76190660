#include <algorithm>
#include <iterator>
#include <optional>

#include "cell/judge/passive.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/json/source.hpp"
#include "server/files/data_files.hpp"
#include "server/files/load_model.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

/// The robot to check a workcell against: from --robot, else the one with the file's name, if any.
std::optional<Robot> robot_for(const CheckOptions& options, const std::string& file) {
  if (options.robot.empty()) return robot_with_name_of(file);
  const DataFile data = find_data_file(options.robot, "robots");
  return load_robot_of_either_form(data.text, data.path);
}

/// A warning if a robot at rest meets all goals without a program. Empty if a goal is missed, or
/// the goals name blocks or joints that the robot does not have.
Findings passive_warning(const CheckOptions& options, const DataFile& data) {
  const std::string robot = options.robot.empty() ? ServeOptions{}.robot : options.robot;
  const ModelPtr model = load_model({robot, "", options.profile});
  const auto goals = read_goals(data.text, data.path, &*model).value;
  if (!goals || std::ranges::count(passive_goals(*goals, model, {}), false) > 0) return {};
  return {{Severity::kWarning, data.path, JsonSource(data.text, data.path).line_of("/goals"), 0,
           "/goals", "only goals that " + robot + " meets at rest, without a program",
           "at least one that it must be moved for; --robot names another robot"}};
}

bool check_file(const CheckOptions& options, const std::string& file) {
  const DataFile data = read_file(file);
  const std::optional<Robot> robot = robot_for(options, file);
  CheckResult result =
      check_either_form(data.text, data.path, options.profile, robot ? &*robot : nullptr);
  if (result.goals)
    std::ranges::move(passive_warning(options, data), std::back_inserter(result.findings));
  print_error(to_text(result.findings));
  print_text(result.summary);
  return result.is_good();
}

}  // namespace

ExitCode run_command(const CheckOptions& options) {
  bool all_good = true;
  for (const std::string& file : options.files) {
    try {
      all_good &= check_file(options, file);
    } catch (const FileError& error) {
      fail(error.code(), error.what());
      all_good = false;
    }
  }
  return all_good ? ExitCode::kGood : ExitCode::kBadInput;
}

}  // namespace xr3
