#include "cell/digest.hpp"

#include <nlohmann/json.hpp>

#include "cell/sha256.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/files/robot.hpp"

namespace xr3 {

std::string sha256(std::string_view text) {
  const Sha256 digest = sha256_bytes(text);
  return "sha256:" + hexadecimal({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

std::string robot_hash(const Model& model) {
  const char* profile = model.profile() == Profile::kPaper ? "paper" : "mark3";
  return sha256(robot_to_json(model.robot()).dump() + profile);
}

}  // namespace xr3
