#include "protocol/goals/file.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/kind.hpp"
#include "protocol/goals/consistency.hpp"
#include "protocol/goals/members.hpp"

namespace xr3 {
namespace {

data::Codec<Goal> goal_codec() { return {"an object { ... }", data::read_goal, nullptr}; }

const data::Members<GoalList>& list_members() {
  constexpr std::size_t kMaxNotes = 4000;
  static const data::Members<GoalList> members = {
      data::optional("notes", &GoalList::notes, data::text(0, kMaxNotes)),
      data::required("goals", &GoalList::goals, data::list(goal_codec(), 1, kMaxGoals))};
  return members;
}

}  // namespace

GoalsReading read_goals(std::string_view text, const std::string& file, const Model* model) try {
  const JsonSource source(text, file);
  refuse_other_kinds(source.root(), DataKind::kGoals, file);
  data::Reading reading(source, data::Unit::kMm);
  GoalList list;
  read_object(data::Place{reading, reading.root()}, list_members(), list);
  check_goals(list, model, reading);
  const bool is_good = !reading.has_errors();
  return {is_good ? std::optional(std::move(list)) : std::nullopt, reading.take_findings()};
} catch (const DataError& error) {
  return {std::nullopt, error.findings()};
}

GoalList load_goals(std::string_view text, const std::string& file, const Model& model) {
  GoalsReading reading = read_goals(text, file, &model);
  if (!reading.list) throw DataError(std::move(reading.findings));
  return *std::move(reading.list);
}

std::string goals_summary(const GoalList& list) {
  int points = 0;
  for (const Goal& each : list.goals) points += each.points;
  std::string text =
      std::to_string(list.goals.size()) + " goals, " + std::to_string(points) + " points\n";
  if (!list.notes.empty()) text += list.notes + "\n";
  for (const Goal& each : list.goals) text += "  " + data::kind_of(each) + "\n";
  return text;
}

}  // namespace xr3
