#include "cell/digest.hpp"

#include <nettle/sha2.h>

#include <array>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/files/robot.hpp"

namespace xr3 {

std::string sha256(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return "sha256:" + hexadecimal({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

std::string robot_hash(const Model& model) {
  const char* profile = model.profile() == Profile::kPaper ? "paper" : "mark3";
  return sha256(robot_to_json(model.robot()).dump() + profile);
}

}  // namespace xr3
