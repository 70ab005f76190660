#include "protocol/explain/diagnostic.hpp"

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
        case Subject::kOutput: return "output lines are 1...8; ignored";
        case Subject::kStatus: return "status line options are 0...6; ignored";
        case Subject::kPeriod: return "the refresh period is 1...255 half seconds; ignored";
        default: return "a move is -128...127 counts; ignored";
      }
    case ProblemCode::kSpeedOutOfRange: return "a speed is 1...255 counts a second; ignored";
    case ProblemCode::kNoJointSelected:
      return "no joint is selected: a letter A...H must come first on the line; skipped";
    case ProblemCode::kIncompleteCommand:
      switch (problem.subject) {
        case Subject::kOutput: return "P and R need the number of an output line, 1...8; ignored";
        case Subject::kView:
          return "a view vector ends with an exclamation mark, as in A!1,1,1!; ignored";
        case Subject::kCamera:
          return "a camera inquiry ends with an asterisk, as in A*3*; not answered";
        case Subject::kPeriod: return "A. needs a number of half seconds, 1...255; ignored";
        case Subject::kStatus: return "A% needs one digit, 0...6; ignored";
        default: return "a sign must be followed by digits, as in E+5; ignored";
      }
    case ProblemCode::kBadViewVector:
      return "a view vector is three integers -9...9, not all 0, as in A!1,1,1!; ignored";
    case ProblemCode::kBadCameraArgument:
      return "camera inquiries are A**, A*row* and A*column,row*; not answered";
    case ProblemCode::kDisabled: return "the simulator is disabled and executes only A@";
    case ProblemCode::kNotForDevice:
      return "a physical controller does not have this; it is not sent to the device";
  }
  return "";
}

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
    case ProblemCode::kNotForDevice: return "not_for_device";
  }
  return "";
}

std::string_view code_of(WarningCode code) {
  switch (code) {
    case WarningCode::kCounterOverflow: return "counter_overflow";
    case WarningCode::kNoSuchJoint: return "no_such_joint";
    case WarningCode::kBadCameraArgument: return "bad_camera_argument";
    case WarningCode::kJawsTooNarrow: return "jaws_too_narrow";
    case WarningCode::kJawsTouch: return "jaws_touch";
    case WarningCode::kBelowSurface: return "below_surface";
    case WarningCode::kReleasedInAir: return "released_in_air";
    case WarningCode::kBlocksOverlap: return "blocks_overlap";
  }
  return "";
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

}  // namespace xr3
