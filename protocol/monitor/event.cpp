#include "protocol/monitor/event.hpp"

#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/explain/explain.hpp"

namespace xr3 {

namespace {

Json explanation_json(Explanation& of) {
  Json::object_t members;
  members.reserve(4);  // an object that grows copies its members
  members["from"] = of.from;
  members["to"] = of.to;
  members["code"] = of.code;
  members["message"] = std::move(of.message);
  return members;
}

}  // namespace

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

Json wire_json(const WireRecord& record, const Model& model) {
  Json::array_t parsed;
  for (Explanation& each : explain(record, model)) parsed.push_back(explanation_json(each));
  Json::object_t members;
  members.reserve(7);
  members["line"] = record.line;
  members["dir"] = record.direction == Direction::kIn ? "in" : "out";
  members["offset"] = record.offset;
  members["hex"] = hexadecimal(record.shown);
  members["text"] = readable(record.shown);
  members["bytes"] = record.bytes;
  members["parsed"] = std::move(parsed);
  return members;
}

}  // namespace xr3
