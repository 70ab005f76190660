#include "protocol/monitor/event.hpp"

#include <nlohmann/json.hpp>

#include "protocol/explain/event_report.hpp"

namespace xr3 {

Json event_json(const CellEvent& event, const Model& model) {
  EventReport about = report(event, model);
  Json members = {{"event", about.event},
                  {"line", event.line ? Json(*event.line) : Json(nullptr)},
                  {"code", about.code},
                  {"message", std::move(about.message)}};
  members.update(about.members);
  return members;
}

}  // namespace xr3
