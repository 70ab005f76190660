#include "server/recording/joint_table.hpp"

#include <iomanip>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "protocol/json/values.hpp"
#include "protocol/text/text_stream.hpp"

namespace xr3 {
namespace {

std::string fixed_text(double value, int decimals) {
  TextStream out;
  out << std::fixed << std::setprecision(decimals) << rounded(value, decimals);
  return out.str();
}

}  // namespace

JointTable::JointTable(const Model& model) {
  text_ = "epoch,tick";
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::string label(1, model.motor(i).drive.label);
    const char* const unit = model.is_length(i) ? "_mm," : "_deg,";
    text_.append(",").append(label).append(unit).append(label).append("_count");
  }
  text_ += ",x_mm,y_mm,z_mm,holding\n";
}

void JointTable::add(const Cell& cell, Tick tick) {
  const Model& model = cell.model();
  const State& state = cell.state();
  const Positions at = positions(model, state.motors);
  text_ += std::to_string(cell.epoch()) + "," + std::to_string(tick);
  for (int i = 0; i < model.motor_count(); ++i) {
    const double value = model.variable(i, at[static_cast<std::size_t>(i)]);
    text_ += "," + fixed_text(value, model.is_length(i) ? kMmDecimals : kDegreeDecimals) + "," +
             std::to_string(state.motor(i).count);
  }
  const PointUm tip = tool_tip(model, at);
  for (const Micrometres um : {tip.x, tip.y, tip.z}) text_ += "," + fixed_text(mm(um), kMmDecimals);
  // A name may have any character: a text in quotes, with those in it doubled.
  std::string name = state.held ? state.blocks[state.held->block].name : "";
  for (std::size_t i = name.find('"'); i != std::string::npos; i = name.find('"', i + 2))
    name.insert(i, 1, '"');
  text_ += name.empty() ? ",\n" : ",\"" + name + "\"\n";
}

}  // namespace xr3
