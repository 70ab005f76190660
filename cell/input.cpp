#include "cell/input.hpp"

namespace xr3 {

std::optional<LineId> line_of(const Input& input) {
  return std::visit(
      [](const auto& each) -> std::optional<LineId> {
        if constexpr (requires { each.line; }) return each.line;
        return std::nullopt;
      },
      input);
}

}  // namespace xr3
