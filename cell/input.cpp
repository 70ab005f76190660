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

bool is_of_probe(const Input& input) {
  const auto* opened = std::get_if<LineOpened>(&input);
  return opened != nullptr ? opened->is_probe : line_of(input) == kProbeLine;
}

}  // namespace xr3
