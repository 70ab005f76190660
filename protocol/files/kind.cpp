#include "protocol/files/kind.hpp"

namespace xr3 {

DataKind kind_of(JsonValue root) {
  if (!root.is_object()) return DataKind::kUnknown;
  if (root.find("title")) return DataKind::kExercise;
  if (root.find("joints")) return DataKind::kRobot;
  if (root.find("workspace") || root.find("blocks")) return DataKind::kWorkcell;
  if (root.find("faults")) return DataKind::kFaults;
  return root.find("goals") ? DataKind::kGoals : DataKind::kUnknown;
}

const char* description_of(DataKind kind) {
  switch (kind) {
    case DataKind::kRobot: return "a robot, with \"joints\" and \"tool\"";
    case DataKind::kWorkcell: return "a workcell, with \"workspace\" and \"blocks\"";
    case DataKind::kFaults: return "a fault file, with \"faults\"";
    case DataKind::kGoals: return "a goals file, with \"goals\"";
    case DataKind::kExercise: return "an exercise, with \"title\" and \"goals\"";
    case DataKind::kUnknown: break;
  }
  return "";
}

void refuse_other_kinds(JsonValue root, DataKind wanted, const std::string& file) {
  const DataKind kind = kind_of(root);
  if (kind == wanted || kind == DataKind::kUnknown) return;
  const std::string description = description_of(kind);
  const std::string found = description.substr(0, description.find(','));
  throw DataError({{Severity::kError, file, 1, 0, "", found, description_of(wanted)}});
}

}  // namespace xr3
