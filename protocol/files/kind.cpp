#include "protocol/files/kind.hpp"

namespace xr3 {

DataKind kind_of(JsonValue root) {
  if (!root.is_object()) return DataKind::kUnknown;
  if (root.find("joints")) return DataKind::kRobot;
  if (root.find("workspace") || root.find("blocks")) return DataKind::kWorkcell;
  return DataKind::kUnknown;
}

void refuse_kind(JsonValue root, DataKind other, const std::string& file) {
  if (kind_of(root) != other) return;
  const bool is_robot = other == DataKind::kRobot;
  const char* found = is_robot ? "a robot" : "a workcell";
  const char* allowed = is_robot ? "a workcell, with \"workspace\" and \"blocks\""
                                 : "a robot, with \"joints\" and \"tool\"";
  throw DataError({{Severity::kError, file, 1, 0, "", found, allowed}});
}

}  // namespace xr3
