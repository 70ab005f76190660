#include "tests/support/words.hpp"

#include <ostream>
#include <sstream>

#include "protocol/explain/command_text.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace test {
namespace {

std::string letter(char label) { return {label}; }
std::string number(int value) { return std::to_string(value); }
std::string counts(int value) { return (value < 0 ? "" : "+") + number(value); }

struct CommandWords {
  /// The code of a command that has no function below.
  template <class Other>
  std::string operator()(const Other& c) const {
    return std::string(code_of(Command(c)));
  }
  std::string operator()(const Move& c) const { return letter(c.label) + counts(c.counts); }
  std::string operator()(const SetSpeed& c) const {
    return letter(c.label) + number(c.counts_per_s) + "S";
  }
  std::string operator()(const Stop& c) const { return letter(c.label) + "X"; }
  std::string operator()(const QueryError& c) const { return letter(c.label) + "?"; }
  std::string operator()(const QuerySignedError& c) const { return letter(c.label) + "T"; }
  std::string operator()(const QuerySwitch& c) const { return letter(c.label) + "V"; }
  std::string operator()(const QuerySwitchesI&) const { return "I"; }
  std::string operator()(const QuerySwitchesJ&) const { return "J"; }
  std::string operator()(const QueryInputs&) const { return "K"; }
  std::string operator()(const SetAuxiliary& c) const {
    return c.port == 1 ? (c.on ? "L" : "M") : (c.on ? "N" : "O");
  }
  std::string operator()(const SetOutput& c) const { return (c.high ? "P" : "R") + number(c.line); }
  std::string operator()(const ControllerReset&) const { return "Q"; }
  std::string operator()(const ToggleDisplay&) const { return "A#"; }
  std::string operator()(const SetViewVector& c) const {
    return "A!" + number(c.x) + "," + number(c.y) + "," + number(c.z) + "!";
  }
  std::string operator()(const SoftHome&) const { return "A$"; }
  std::string operator()(const ToggleSimulator&) const { return "A@"; }
  std::string operator()(const SetRefreshPeriod& c) const { return "A." + number(c.half_seconds); }
  std::string operator()(const ToggleErasing&) const { return "A|"; }
  std::string operator()(const SelectStatus& c) const { return "A%" + number(c.option); }
  std::string operator()(const ToggleFunctionKeys&) const { return "Alt F6"; }
  std::string operator()(const CameraImage&) const { return "A**"; }
  std::string operator()(const CameraRow& c) const { return "A*" + number(c.row) + "*"; }
  std::string operator()(const CameraPixel& c) const {
    return "A*" + number(c.column) + "," + number(c.row) + "*";
  }
};

struct ReplyWords {
  template <class Other>
  std::string operator()(const Other&) const {
    return "another reply";
  }
  std::string operator()(const NoReply&) const { return "no reply"; }
  std::string operator()(const ErrorMagnitude& r) const { return "to go " + number(r.counts); }
  std::string operator()(const SignedError& r) const { return "to go " + counts(r.counts); }
  std::string operator()(const SwitchState& r) const { return r.closed ? "closed" : "open"; }
  std::string operator()(const SwitchBits& r) const {
    return letter(r.inquiry) + " closed " + number(r.closed) + " of " + number(r.fitted) +
           ", inputs " + number(r.inputs);
  }
  std::string operator()(const CameraRows& r) const { return number(r.image->height()) + " rows"; }
  std::string operator()(const PixelValue& r) const { return r.set ? "pixel 1" : "pixel 0"; }
};

std::string words(const MotorState& motor) {
  std::ostringstream out;
  out << "count " << motor.count << " to go " << static_cast<int>(motor.error) << " phase "
      << motor.phase << " speed " << static_cast<int>(motor.speed) << " blocked "
      << static_cast<int>(motor.blocked) << (motor.switch_closed ? " closed" : " open");
  return out.str();
}

}  // namespace

std::string words(const Command& command) { return std::visit(CommandWords{}, command); }

std::string words(const Parsed& parsed) {
  const Problem* problem = std::get_if<Problem>(&parsed.what);
  if (problem != nullptr) return std::string(code_of(problem->code));
  return words(std::get<Command>(parsed.what));
}

std::string words(const std::vector<Parsed>& parsed) {
  std::string all;
  for (const Parsed& item : parsed) all += (all.empty() ? "" : " ") + words(item);
  return all;
}

std::string words(const Reply& reply) { return std::visit(ReplyWords{}, reply); }

std::string words(const State& state) {
  std::ostringstream out;
  out << "tick " << state.tick << " stall " << static_cast<int>(state.stall) << " below "
      << state.below_surface << " enabled " << state.enabled << "\n";
  for (std::size_t i = 0; i < state.motors.size(); ++i) {
    out << "  motor " << i << ": " << words(state.motors[i]) << "\n";
  }
  const DisplaySettings& display = state.display;
  out << "  display " << display.on << " view " << display.view.x << "," << display.view.y << ","
      << display.view.z << " period " << display.period_half_s << " erase " << display.erase
      << " status " << display.status_option << " keys " << display.function_keys << "\n  inputs "
      << static_cast<int>(state.io.inputs) << " outputs " << static_cast<int>(state.io.outputs)
      << " auxiliary " << static_cast<int>(state.io.auxiliary);
  return out.str();
}

}  // namespace test

void PrintTo(const State& state, std::ostream* out) { *out << test::words(state); }
void PrintTo(const Reply& reply, std::ostream* out) { *out << test::words(reply); }
void PrintTo(const Parsed& parsed, std::ostream* out) {
  *out << test::words(parsed) << " from [" << parsed.from << ", " << parsed.to << ") '"
       << readable(parsed.raw.view()) << "'";
}

}  // namespace xr3
