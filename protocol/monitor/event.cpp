#include "protocol/monitor/event.hpp"

#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/event_report.hpp"

namespace xr3 {

Json event_json(const CellEvent& event, const Model& model) {
  EventReport about = report(event, model);
  Json::object_t members;
  members.reserve(4 + about.members.size());  // an object that grows copies its members
  members["event"] = about.event;
  members["line"] = event.line ? Json(*event.line) : Json(nullptr);
  members["code"] = about.code;
  members["message"] = std::move(about.message);
  members.insert(std::make_move_iterator(about.members.begin()),
                 std::make_move_iterator(about.members.end()));
  return members;
}

}  // namespace xr3
