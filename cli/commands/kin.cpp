#include <algorithm>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/json/text.hpp"
#include "server/files/data_files.hpp"
#include "server/print.hpp"
#include "tools/kin/report.hpp"
#include "tools/kin/text.hpp"

namespace xr3 {
namespace {

ExitCode answer(const Model& model, const DirectQuestion& question, bool as_json) {
  if (as_json) print_json(json_text(direct_json(model, question)));
  if (!as_json) print_text(direct_text(model, question));
  return ExitCode::kGood;
}

ExitCode answer(const Model& model, const InverseQuestion& question, bool as_json) {
  const InverseResult result = solve_inverse(model, question.target, question.options);
  if (as_json) print_json(json_text(inverse_json(model, question.target, result)));
  if (result.solutions.empty()) return fail(ExitCode::kBadInput, refusal_of(result).text);
  if (!as_json) print_text(inverse_text(model, question.target, result));
  return std::ranges::any_of(result.solutions, &InverseSolution::is_allowed)
             ? ExitCode::kGood
             : fail(ExitCode::kBadInput,
                    "no solution is within the limits and outside the protected region");
}

}  // namespace

ExitCode run_command(const KinOptions& options) try {
  const DataFile file = find_data_file(options.robot, "robots");
  const Model model(load_robot_of_either_form(file.text, file.path), Workcell{}, Profile::kPaper);
  return std::visit([&](const auto& question) { return answer(model, question, options.is_json); },
                    kin_question(model, options.values));
} catch (const KinQuestionError& error) {
  return fail(ExitCode::kBadInput, error.what());
}

}  // namespace xr3
