#include "cell/digest.hpp"

#include <nlohmann/json.hpp>

#include "protocol/files/robot.hpp"

namespace xr3 {

std::string robot_hash(const Model& model) {
  const char* profile = model.profile() == Profile::kPaper ? "paper" : "mark3";
  return sha256(robot_to_json(model.robot()).dump() + profile);
}

}  // namespace xr3
