#include "protocol/explain/diagnostic.hpp"

#include <array>
#include <cstdio>

namespace xr3 {
namespace {

std::string_view sentence(const Problem& problem) {
  switch (problem.code) {
    case ProblemCode::kUnknownByte:
      if (problem.subject == Subject::kSkippedNumber) {
        return "skipped: after an unknown byte, numbers are ignored up to the next letter";
      }
      if (problem.subject == Subject::kSpeed) {
        return "S sets a speed only directly after a number without a sign, as in E60S; skipped";
      }
      return "no command begins like this here; skipped";
    case ProblemCode::kNumberOutOfRange:
      switch (problem.subject) {
        case Subject::kOutput: return "output lines are 1...8; not obeyed";
        case Subject::kStatus: return "status line options are 0...6; not obeyed";
        case Subject::kPeriod: return "the refresh period is 1...255 half seconds; not obeyed";
        default: return "a move is -128...127 counts; not obeyed";
      }
    case ProblemCode::kSpeedOutOfRange: return "a speed is 1...255 counts a second; not obeyed";
    case ProblemCode::kNoJointSelected:
      return "no joint is selected: a letter A...H must come first on the line; skipped";
    case ProblemCode::kIncompleteCommand:
      switch (problem.subject) {
        case Subject::kOutput:
          return "P and R need the number of an output line, 1...8; not obeyed";
        case Subject::kView:
          return "a view vector ends with an exclamation mark, as in A!1,1,1!; not obeyed";
        case Subject::kCamera:
          return "a camera inquiry ends with an asterisk, as in A*3*; not answered";
        case Subject::kPeriod: return "A. needs a number of half seconds, 1...255; not obeyed";
        case Subject::kStatus: return "A% needs one digit, 0...6; not obeyed";
        default: return "a sign must be followed by digits, as in E+5; not obeyed";
      }
    case ProblemCode::kBadViewVector:
      return "a view vector is three integers -9...9, not all 0, as in A!1,1,1!; not obeyed";
    case ProblemCode::kBadCameraArgument:
      return "camera inquiries are A**, A*row* and A*column,row*; not answered";
    case ProblemCode::kDisabled: return "the simulator is disabled and obeys only A@";
  }
  return "";
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

const char* unit_of(const Model& model, char label) {
  const int index = model.index_of(label);
  if (index == model.tool_index())
    return model.robot().tool.kind == ToolKind::kParallel ? "mm" : "deg";
  const auto variable = model.robot().joints[static_cast<std::size_t>(index)].variable;
  return variable == JointVariable::kD ? "mm" : "deg";
}

struct Describer {
  const Model& model;

  std::string operator()(const MoveTaken& e) const {
    return std::string(1, e.label) + " " + signed_number(e.counts) + ": counter " +
           std::to_string(e.error);
  }
  std::string operator()(const Reached& e) const {
    return std::string(1, e.label) + " has reached its target";
  }
  std::string operator()(const MotorBlocked& e) const {
    const std::string left =
        ", " + std::to_string(e.error < 0 ? -e.error : e.error) + " counts short";
    if (e.why == Blocked::kBlock) return "the jaws are closed on a block" + left;
    const std::string limit = std::string(e.upper ? "upper" : "lower") + " limit of " +
                              number(e.limit) + " " + unit_of(model, e.by);
    if (e.by == e.label) return std::string(1, e.label) + " is at its " + limit + left;
    return std::string(1, e.label) + " is blocked because it would move " + e.by + " past its " +
           limit + left;
  }
  std::string operator()(const Stalled& e) const {
    return std::string(e.why == Stall::kProtectedRegion
                           ? "the tool would enter the protected region"
                           : "the tool would pass under the work surface") +
           "; A$ or reset clears the stall";
  }
  std::string operator()(const SwitchChanged& e) const {
    return std::string("the microswitch of ") + e.label + (e.closed ? " closed" : " opened");
  }
  std::string operator()(const Grasped& e) const { return "the jaws hold block " + e.block; }
  std::string operator()(const Released& e) const { return "block " + e.block + " released"; }
  std::string operator()(const Homed&) const { return "soft home"; }
  std::string operator()(const OutputChanged& e) const {
    return "output " + std::to_string(e.line) + (e.high ? " is high" : " is low");
  }
  std::string operator()(const InputChanged& e) const {
    return "input " + std::to_string(e.line) + (e.high ? " is high" : " is low");
  }
  std::string operator()(const AuxiliaryChanged& e) const {
    return "auxiliary port " + std::to_string(e.port) + (e.on ? " is on" : " is off");
  }
  std::string operator()(const EnabledChanged& e) const {
    return e.enabled ? "the simulator is enabled" : "the simulator is disabled; only A@ is obeyed";
  }
  std::string operator()(const Warning& e) const {
    const std::string label(1, e.label);
    switch (e.code) {
      case WarningCode::kCounterOverflow:
        return label + signed_number(e.value) + ": the 8-bit error counter wrapped to " +
               std::to_string(e.limit) + "; wait until " + label +
               " is nearer to its target before sending more";
      case WarningCode::kNoSuchJoint:
        return label + ": this robot has no such joint; it has A..." +
               std::string(1, static_cast<char>('A' + model.joint_count()));
      case WarningCode::kBadCameraArgument: return camera_words();
      case WarningCode::kJawsTooNarrow:
        return "the jaws are already narrower than block " + e.block +
               ": open them before closing on it";
      case WarningCode::kBelowSurface: return "the tool tip passed under the work surface";
    }
    return "";
  }

 private:
  std::string camera_words() const {
    const auto& camera = model.workcell().camera;
    if (!camera) return "this workcell has no camera; not answered";
    return "the camera has columns 0..." + std::to_string(camera->pixels_x - 1) + " and rows 0..." +
           std::to_string(camera->pixels_y - 1) + "; not answered";
  }
};

}  // namespace

std::string_view code_of(ProblemCode code) {
  switch (code) {
    case ProblemCode::kUnknownByte: return "unknown_byte";
    case ProblemCode::kNumberOutOfRange: return "number_out_of_range";
    case ProblemCode::kSpeedOutOfRange: return "speed_out_of_range";
    case ProblemCode::kNoJointSelected: return "no_joint_selected";
    case ProblemCode::kIncompleteCommand: return "incomplete_command";
    case ProblemCode::kBadViewVector: return "bad_view_vector";
    case ProblemCode::kBadCameraArgument: return "bad_camera_argument";
    case ProblemCode::kDisabled: return "disabled";
  }
  return "";
}

std::string_view code_of(WarningCode code) {
  switch (code) {
    case WarningCode::kCounterOverflow: return "counter_overflow";
    case WarningCode::kNoSuchJoint: return "no_such_joint";
    case WarningCode::kBadCameraArgument: return "bad_camera_argument";
    case WarningCode::kJawsTooNarrow: return "jaws_too_narrow";
    case WarningCode::kBelowSurface: return "below_surface";
  }
  return "";
}

std::string_view code_of(const EventBody& event) {
  struct Codes {
    std::string_view operator()(const MoveTaken&) const { return "move"; }
    std::string_view operator()(const Reached&) const { return "reached"; }
    std::string_view operator()(const MotorBlocked& e) const {
      return e.why == Blocked::kLimit ? "limit" : "block";
    }
    std::string_view operator()(const Stalled& e) const {
      return e.why == Stall::kProtectedRegion ? "protected_region" : "work_surface";
    }
    std::string_view operator()(const SwitchChanged&) const { return "switch"; }
    std::string_view operator()(const Grasped&) const { return "grasped"; }
    std::string_view operator()(const Released&) const { return "released"; }
    std::string_view operator()(const Homed&) const { return "homed"; }
    std::string_view operator()(const OutputChanged&) const { return "io"; }
    std::string_view operator()(const InputChanged&) const { return "io"; }
    std::string_view operator()(const AuxiliaryChanged&) const { return "io"; }
    std::string_view operator()(const EnabledChanged& e) const {
      return e.enabled ? "enabled" : "disabled";
    }
    std::string_view operator()(const Warning& e) const { return code_of(e.code); }
  };
  return std::visit(Codes{}, event);
}

std::string signed_number(int value) { return (value < 0 ? "" : "+") + std::to_string(value); }

std::string readable(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\r')
      text += "\\r";
    else if (c == '\n')
      text += "\\n";
    else if (c == '\0')
      text += "\\0";
    else if (c == '\\')
      text += "\\\\";
    else if (byte >= ' ' && byte < 0x7f)
      text += c;
    else
      text += "\\x" + hexadecimal({&c, 1});
  }
  return text;
}

std::string hexadecimal(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string describe(const Parsed& parsed, const Problem& problem) {
  std::string_view bytes = parsed.raw.view();
  while (!bytes.empty() && (bytes.back() == '\r' || bytes.back() == '\n' || bytes.back() == ' ')) {
    bytes.remove_suffix(1);
  }
  const std::string before =
      bytes.empty() ? "" : readable(bytes) + (parsed.raw.was_cut ? "..." : "") + ": ";
  return before + std::string(sentence(problem));
}

std::string describe(const EventBody& event, const Model& model) {
  return std::visit(Describer{model}, event);
}

}  // namespace xr3
