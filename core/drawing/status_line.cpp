#include "core/drawing/status_line.hpp"

#include <array>
#include <cstdio>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"

namespace xr3 {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value + 0.0);
  const bool is_negative_zero =
      std::string_view(text.data()).find_first_not_of("-0.") == std::string_view::npos;
  return is_negative_zero && text[0] == '-' ? text.data() + 1 : text.data();
}

/// "F ...  E ...  A ...", from the base to the tool.
template <class Say>
std::string of_each_motor(const Model& model, Say say) {
  std::string line;
  for (int i = 0; i < model.motor_count(); ++i) {
    line += (line.empty() ? "" : "  ") + std::string(1, model.motor(i).drive.label) + " " + say(i);
  }
  return line;
}

std::string configuration(const Model& model, const Positions& positions) {
  const ToolConfiguration w = tool_configuration(model, positions);
  std::string line;
  for (int i = 0; i < w.size(); ++i) line += (i == 0 ? "" : "  ") + fixed(w(i), i < 3 ? 1 : 4);
  return line;
}

std::string variables(const Model& model, const Positions& positions) {
  return of_each_motor(model, [&](int i) {
    return fixed(model.variable(i, positions[static_cast<std::size_t>(i)]), 1);
  });
}

std::string tool(const Model& model, const State& state, const Positions& positions) {
  const double opening = opening_mm(model, positions[static_cast<std::size_t>(model.tool_index())]);
  const std::string held = state.held ? state.blocks[state.held->block].name : "nothing";
  return fixed(opening, 1) + " mm open, holds " + held;
}

}  // namespace

std::string status_line(const Model& model, const State& state) {
  const Positions now = positions(model, state.motors);
  switch (state.display.status_option) {
    case 1: return configuration(model, now);
    case 2: return variables(model, now);
    case 3:
      return of_each_motor(model, [&](int i) { return std::to_string(state.motor(i).error); });
    case 4:
      return of_each_motor(model, [&](int i) { return std::to_string(state.motor(i).count); });
    case 5:
      return of_each_motor(model, [&](int i) -> std::string {
        return state.motor(i).switch_closed ? "closed" : "open";
      });
    case 6: return tool(model, state, now);
    default: return "";
  }
}

}  // namespace xr3
