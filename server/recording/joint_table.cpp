#include "server/recording/joint_table.hpp"

#include <cassert>
#include <iomanip>
#include <utility>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "protocol/json/values.hpp"
#include "protocol/text/text_stream.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kWrittenAtOnce = std::size_t{64} * 1024;

std::string fixed_text(double value, int decimals) {
  TextStream out;
  out << std::fixed << std::setprecision(decimals) << rounded(value, decimals);
  return out.str();
}

/// The name of the held block, quoted, since it may have any character; empty if there is none.
std::string held_text(const State& state) {
  if (!state.held) return "";
  std::string name = state.blocks[state.held->block].name;
  for (std::size_t i = name.find('"'); i != std::string::npos; i = name.find('"', i + 2))
    name.insert(i, 1, '"');
  return "\"" + name + "\"";
}

/// The columns of motors and tip.
std::string columns(const Model& model, const Motors& motors) {
  const Positions at = positions(model, motors);
  std::string text;
  for (int i = 0; i < model.motor_count(); ++i) {
    const double value = model.variable(i, at[static_cast<std::size_t>(i)]);
    text += "," + fixed_text(value, model.is_length(i) ? kMmDecimals : kDegreeDecimals) + "," +
            std::to_string(motors[static_cast<std::size_t>(i)].count);
  }
  const PointUm tip = tool_tip(model, at);
  for (const Micrometres um : {tip.x, tip.y, tip.z}) text += "," + fixed_text(mm(um), kMmDecimals);
  return text;
}

}  // namespace

JointTable::JointTable(const Model& model, const std::filesystem::path& path) : draft_(path) {
  waiting_ = "epoch,tick";
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::string label(1, model.motor(i).drive.label);
    const char* const unit = model.is_length(i) ? "_mm," : "_deg,";
    waiting_.append(",").append(label).append(unit).append(label).append("_count");
  }
  waiting_ += ",x_mm,y_mm,z_mm,holding\n";
}

// A robot that rests for hours gives many lines with the same columns.
void JointTable::add(const Cell& cell, Tick tick) {
  assert(!is_full());
  const State& state = cell.state();
  if (rows_ == 0 || state.motors != motors_) {
    last_ = columns(cell.model(), state.motors);
    motors_ = state.motors;
  }
  waiting_ += std::to_string(cell.epoch()) + "," + std::to_string(tick) + last_ + "," +
              held_text(state) + "\n";
  ++rows_;
  if (waiting_.size() >= kWrittenAtOnce) draft_.append(std::exchange(waiting_, {}));
}

void JointTable::finish() {
  draft_.append(waiting_);
  draft_.sync();
  draft_.take_name(Existing::kReplace);
}

}  // namespace xr3
