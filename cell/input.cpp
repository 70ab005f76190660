#include "cell/input.hpp"

namespace xr3 {

LineId line_of(const Input& input) {
  return std::visit(
      [](const auto& each) -> LineId {
        if constexpr (requires { each.line; }) return each.line;
        return kProbeLine;
      },
      input);
}

bool is_of_line(const Input& input) {
  return std::holds_alternative<BytesIn>(input) || std::holds_alternative<LineSettings>(input) ||
         std::holds_alternative<InputEnded>(input) || std::holds_alternative<LineClosed>(input) ||
         std::holds_alternative<LineSilent>(input);
}

bool is_of_probe(const Input& input) {
  const auto* opened = std::get_if<LineOpened>(&input);
  return opened != nullptr ? opened->is_probe : is_of_line(input) && line_of(input) == kProbeLine;
}

}  // namespace xr3
