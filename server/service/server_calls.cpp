#include "server/service/server_calls.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/call_table.hpp"
#include "server/service/sessions.hpp"
#include "service/answer.hpp"

namespace xr3 {

asio::awaitable<void> ServerCalls::carry_out(CallOf of, const monitor::ListCells&) {
  const std::vector<monitor::CellSummary> summaries = co_await overview_.summaries();
  Json list = Json::array();
  for (const monitor::CellSummary& each : summaries) {
    const CellPtr at = cells_.find(each.name);
    if (!at || !MonitorSessions::may_see(of.session, *at)) continue;
    Json entry = monitor::summary_json(each);
    const bool knows_all = of.session.access() == Access::kControl;
    if (knows_all && !at->token().empty()) entry["token"] = at->token();
    list.push_back(std::move(entry));
  }
  of.session.send(
      monitor::result(of.id(), {{"cells", std::move(list)}, {"exercise", exercise_json()}}));
}

/// The exercise of the first cell that has one; null if none has.
Json ServerCalls::exercise_json() const {
  const auto first = std::ranges::find_if(
      cells_.all(), [](const CellPtr& each) { return each->goals() != nullptr; });
  if (first == cells_.all().end()) return {};
  const LiveExercise& exercise = (*first)->goals()->exercise();
  return {{"title", exercise.title}, {"goals", exercise.sentences}};
}

asio::awaitable<void> ServerCalls::carry_out(CallOf of, const monitor::Describe& describe) {
  Json value = of.at ? service::value_now(of.cell()) : Json{{"epoch", nullptr}, {"tick", nullptr}};
  value.update(monitor::description(describe.fn));
  of.session.send(monitor::result(of.id(), value));
  if (of.at) of.at->after_input();
  co_return;
}

}  // namespace xr3
