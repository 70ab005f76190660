#include "protocol/explain/diagnostic.hpp"

#include <array>

#include "protocol/line/device_command.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

constexpr std::string_view kNoWords =
    "the controller has no such word: each letter was a command; ";

/// The commands for what the word means, behind kNoWords.
std::string_view remedy(Subject subject) {
  switch (subject) {
    case Subject::kLeaving:
      return "to leave, close the connection: ~. in xr3 term, Ctrl-] and quit in telnet, Ctrl-C in "
             "nc";
    case Subject::kStopping: return "EX stops joint E, and Q stops all joints";
    case Subject::kHoming: return "A$ returns to the soft home";
    case Subject::kResetting: return "Q resets the controller, and A$ returns to the soft home";
    case Subject::kJaws: return "moves of A open and close the jaws, such as A+20 or A-20";
    default:
      return "E+50 moves joint E, E? asks how far it has to go, and docs/protocol.md has all "
             "commands";
  }
}

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
    case ProblemCode::kDecimalPoint:
      return problem.subject == Subject::kPeriod
                 ? "counts are whole numbers: the number ended before the point, and A. sets the "
                   "refresh period"
                 : "counts and speeds are whole numbers: the number ended before the point; "
                   "skipped";
    case ProblemCode::kWord: return remedy(problem.subject);
  }
  return "";
}

/// Letters in the order of the alphabet, consecutive ones as A...F: `A...D, G`.
std::string runs_of(const std::string& letters) {
  std::string text;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const bool continues = i > 0 && letters[i] == letters[i - 1] + 1;
    const bool ends = i + 1 == letters.size() || letters[i + 1] != letters[i] + 1;
    if (!continues) text += (i > 0 ? ", " : "") + letter_text(letters[i]);
    if (continues && ends) text += "..." + letter_text(letters[i]);
  }
  return text;
}

std::string camera_text(const Model& model) {
  const auto& camera = model.workcell().camera;
  if (!camera) return "this workcell has no camera; not answered";
  return "the camera has columns 0..." + std::to_string(camera->pixels_x - 1) + " and rows 0..." +
         std::to_string(camera->pixels_y - 1) + "; not answered";
}

// The name of a block. Explanations of a line's bytes have no names; see wire::WarningRaised.
std::string block_text(const std::string& name, const char* without_name) {
  return name.empty() ? without_name : "block " + name;
}

/// Whether the warning is about the carousel: its label says so.
bool is_of_carousel(const Warning& warning, const Model& model) {
  return model.carousel() && model.index_of(warning.label) == model.carousel_index();
}

std::string air_text(const Warning& warning, const Model& model) {
  const char* surface = warning.block.empty()            ? "what is below it"
                        : is_of_carousel(warning, model) ? "the carousel"
                                                         : "the work surface";
  return block_text(warning.block, "the block") + " was released " +
         significant_digits(mm(Micrometres{warning.value}), 6) + " mm above " +
         block_text(warning.other, surface) + " and stays in the air: release it lower";
}

std::string overlap_text(const Warning& warning, const Model& model) {
  if (is_of_carousel(warning, model)) {
    return block_text(warning.block, "the block") +
           " overlaps the carousel: put it on its top or beside it";
  }
  const int more = warning.value - 1;
  return block_text(warning.block, "the block") + " overlaps " +
         block_text(warning.other, "another block") +
         (more > 0 ? " and " + std::to_string(more) + " more" : "") + ": put it where no block is";
}

}  // namespace

std::string_view code_of(ProblemCode code) {
  constexpr std::array<std::string_view, 11> kCodes = {"unknown_byte",
                                                       "number_out_of_range",
                                                       "speed_out_of_range",
                                                       "no_joint_selected",
                                                       "incomplete_command",
                                                       "bad_view_vector",
                                                       "bad_camera_argument",
                                                       "disabled",
                                                       "not_for_device",
                                                       "decimal_point",
                                                       "word"};
  return kCodes.at(static_cast<std::size_t>(code));
}

std::string_view code_of(WarningCode code) {
  constexpr std::array<std::string_view, 8> kCodes = {
      "counter_overflow", "no_such_joint", "bad_camera_argument", "jaws_too_narrow",
      "jaws_touch",       "below_surface", "released_in_air",     "blocks_overlap"};
  return kCodes.at(static_cast<std::size_t>(code));
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
  return before + std::string(problem.code == ProblemCode::kWord ? kNoWords : "") +
         std::string(sentence(problem));
}

std::string text_of(const Warning& warning, const Model& model) {
  const std::string label = letter_text(warning.label);
  switch (warning.code) {
    case WarningCode::kCounterOverflow:
      return label + signed_number(warning.value) + ": the 8-bit error counter wrapped to " +
             std::to_string(warning.limit) + "; wait until " + label +
             " is nearer to its target before sending more";
    case WarningCode::kNoSuchJoint:
      return label + ": this robot has no such joint; it has " + runs_of(model.labels());
    case WarningCode::kBadCameraArgument: return camera_text(model);
    case WarningCode::kJawsTooNarrow:
      return "the jaws are already narrower than block " + warning.block +
             ": open them before closing on it";
    case WarningCode::kJawsTouch:
      return "the jaws stopped at the width of block " + warning.block +
             " and do not hold it: close them further";
    case WarningCode::kBelowSurface:
      return std::string("the tool tip passed under the work surface") +
             (model.carousel() ? " or the top of the carousel" : "");
    case WarningCode::kReleasedInAir: return air_text(warning, model);
    case WarningCode::kBlocksOverlap: return overlap_text(warning, model);
  }
  return "";
}

ProblemNote disabled_note() {
  const Problem problem{ProblemCode::kDisabled, Subject::kNone};
  return {code_of(problem.code), describe(Parsed{}, problem)};
}

ProblemNote cooked_note() {
  return {"pty_cooked",
          "the program's terminal echoes or edits lines: replies come back as commands, and bytes "
          "wait for Enter; set it raw, as with stty raw -echo"};
}

ProblemNote hurry_note(char label) {
  return {"byte_clock_hurry",
          letter_text(label) +
              " gets another motion command before it has arrived, and no inquiry came since: a "
              "program that sleeps instead of asking needs --clock real; the byte clock stands "
              "while it sleeps"};
}

ProblemNote silent_note(const Command& inquiry) {
  return {"device_silent", "the device has not answered " + readable(for_device(inquiry)->bytes) +
                               " within half a second; the inquiry is forgotten"};
}

}  // namespace xr3
