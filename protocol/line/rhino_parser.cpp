#include "protocol/line/rhino_parser.hpp"

#include <algorithm>
#include <optional>

#include "protocol/line/byte_classes.hpp"

namespace xr3 {
namespace {

constexpr std::int32_t kSaturated = 1'000'000;

bool is_digit(std::uint8_t byte) { return byte >= '0' && byte <= '9'; }
bool is_sign(std::uint8_t byte) { return byte == '+' || byte == '-'; }
bool is_blank(std::uint8_t byte) { return is_line_end(byte) || is_space(byte); }
bool is_within(int value, int min, int max) { return value >= min && value <= max; }

}  // namespace

void RhinoParser::Number::push(std::uint8_t digit) {
  const int value = digit - '0';
  magnitude = std::min(kSaturated, magnitude * 10 + value);
  modulo_256 = static_cast<std::uint8_t>(modulo_256 * 10 + value);
  digits = static_cast<std::uint8_t>(std::min(digits + 1, 255));
}

void RhinoParser::feed(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out) {
  offset_ = offset;
  const std::optional<Parsed> word = word_.feed(byte, offset);
  const bool was_number = mode_ == Mode::kNumber;
  const bool is_argument = mode_ != Mode::kIdle && feed_argument(byte, out);
  if (was_number && byte == '.') {
    feed_decimal_point(out);
  } else if (!is_argument) {
    feed_idle(byte, out);
  }
  if (word) out.push_back(*word);
}

void RhinoParser::feed_disabled(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out) {
  const bool has_a = mode_ == Mode::kIdle && label_ == 'A';
  const bool completes = has_a && byte == '@';
  const bool keeps = has_a && is_space(byte);
  if (!completes && !keeps) *this = RhinoParser(profile_);
  offset_ = offset;
  if (completes) return feed_environment(byte, out);
  if (letter_of(byte) == 'A') return select('A', byte);
  if (!is_blank(byte)) emit_byte(byte, Problem{ProblemCode::kDisabled, Subject::kNone}, out);
}

// --- Between arguments.

void RhinoParser::feed_idle(std::uint8_t byte, std::vector<Parsed>& out) {
  if (const std::uint8_t letter = letter_of(byte)) return feed_letter(letter, byte, out);
  if (is_digit(byte) || is_sign(byte)) return feed_number_start(byte, out);
  if (is_space(byte)) {
    if (raw_.size > 0) consume(byte);
    return;
  }
  if (is_line_end(byte)) {
    *this = RhinoParser(profile_);
    return;
  }
  if (byte == '?' && label_ != 0) return emit_byte(byte, Command{QueryError{label_}}, out);
  if (byte == '?')
    return emit_byte(byte, Problem{ProblemCode::kNoJointSelected, Subject::kNone}, out);
  feed_environment(byte, out);
}

void RhinoParser::feed_letter(std::uint8_t letter, std::uint8_t byte, std::vector<Parsed>& out) {
  skips_numbers_ = false;
  if (letter <= 'H') return select(letter, byte);
  const auto for_joint = [&](auto command) {
    if (label_ == 0)
      return emit_byte(byte, Problem{ProblemCode::kNoJointSelected, Subject::kNone}, out);
    emit_byte(byte, Command{command}, out);
  };
  switch (letter) {
    case 'I': return emit_byte(byte, Command{QuerySwitchesI{}}, out);
    case 'J': return emit_byte(byte, Command{QuerySwitchesJ{}}, out);
    case 'K': return emit_byte(byte, Command{QueryInputs{}}, out);
    case 'L': return emit_byte(byte, Command{SetAuxiliary{1, true}}, out);
    case 'M': return emit_byte(byte, Command{SetAuxiliary{1, false}}, out);
    case 'N': return emit_byte(byte, Command{SetAuxiliary{2, true}}, out);
    case 'O': return emit_byte(byte, Command{SetAuxiliary{2, false}}, out);
    case 'P':
    case 'R': opener_ = static_cast<char>(letter); return open(Mode::kOutput, byte);
    case 'Q': return emit_byte(byte, Command{ControllerReset{}}, out);
    case 'T': return for_joint(QuerySignedError{label_});
    case 'V': return for_joint(QuerySwitch{label_});
    case 'X': return for_joint(Stop{label_});
    case 'S': {
      const auto code = label_ == 0 ? ProblemCode::kNoJointSelected : ProblemCode::kUnknownByte;
      return junk(byte, {code, Subject::kSpeed}, out);
    }
    default: return junk(byte, {ProblemCode::kUnknownByte, Subject::kNone}, out);
  }
}

void RhinoParser::select(std::uint8_t letter, std::uint8_t byte) {
  raw_ = {};
  label_ = static_cast<char>(letter);
  consume(byte);
}

void RhinoParser::feed_number_start(std::uint8_t byte, std::vector<Parsed>& out) {
  if (skips_numbers_) return junk(byte, {ProblemCode::kUnknownByte, Subject::kSkippedNumber}, out);
  if (label_ == 0) return junk(byte, {ProblemCode::kNoJointSelected, Subject::kMove}, out);
  open(Mode::kNumber, byte);
  if (is_sign(byte)) number_.sign = static_cast<char>(byte);
  if (is_digit(byte)) number_.push(byte);
}

// `A` and a sign. With another label or none, the sign is an unknown byte.
void RhinoParser::feed_environment(std::uint8_t byte, std::vector<Parsed>& out) {
  constexpr std::string_view kSigns = "#$@|!*.%";
  const bool is_known =
      label_ == 'A' && kSigns.find(static_cast<char>(byte)) != std::string_view::npos;
  if (!is_known) return junk(byte, {ProblemCode::kUnknownByte, Subject::kNone}, out);
  label_ = 0;
  opener_ = static_cast<char>(byte);
  switch (byte) {
    case '#': return emit_byte(byte, Command{ToggleDisplay{}}, out);
    case '$': return emit_byte(byte, Command{SoftHome{}}, out);
    case '@': return emit_byte(byte, Command{ToggleSimulator{}}, out);
    case '|': return emit_byte(byte, Command{ToggleErasing{}}, out);
    case '!': return open(Mode::kView, byte);
    case '*': return open(Mode::kCamera, byte);
    case '.': return open(Mode::kPeriod, byte);
    default: return open(Mode::kStatus, byte);
  }
}

// A number has ended before this point. After A, a point is a command, too.
void RhinoParser::feed_decimal_point(std::vector<Parsed>& out) {
  if (label_ != 'A') return junk('.', {ProblemCode::kDecimalPoint, Subject::kMove}, out);
  emit_byte('.', Problem{ProblemCode::kDecimalPoint, Subject::kPeriod}, out);
  feed_environment('.', out);
}

// --- Arguments.

bool RhinoParser::feed_argument(std::uint8_t byte, std::vector<Parsed>& out) {
  switch (mode_) {
    case Mode::kNumber: return feed_number(byte, out);
    case Mode::kPeriod: return feed_period(byte, out);
    case Mode::kView:
    case Mode::kCamera: return feed_list(byte, out);
    default: return feed_digit(byte, out);
  }
}

// Handles a byte of the number after a label. A blank that ends it belongs to it, and so does S
// after an unsigned number.
bool RhinoParser::feed_number(std::uint8_t byte, std::vector<Parsed>& out) {
  if (is_digit(byte)) {
    number_.push(byte);
    consume(byte);
    return true;
  }
  const bool sets_speed = letter_of(byte) == 'S' && number_.sign == 0;
  const bool belongs = is_blank(byte) || sets_speed;
  if (belongs) consume(byte);
  if (sets_speed && is_within(number_.magnitude, SetSpeed::kMin, SetSpeed::kMax)) {
    emit(Command{SetSpeed{label_, number_.magnitude}}, out);
  } else if (sets_speed) {
    emit(Problem{ProblemCode::kSpeedOutOfRange, Subject::kSpeed}, out);
  } else {
    end_number(out);
  }
  if (is_line_end(byte)) *this = RhinoParser(profile_);
  return belongs;
}

void RhinoParser::end_number(std::vector<Parsed>& out) {
  if (number_.digits == 0) {
    skips_numbers_ = true;
    return emit(Problem{ProblemCode::kIncompleteCommand, Subject::kMove}, out);
  }
  if (profile_ == Profile::kMark3) {
    const int counts = number_.sign == '-' ? -number_.modulo_256 : number_.modulo_256;
    return emit(Command{Move{label_, static_cast<std::int8_t>(counts)}}, out);
  }
  if (!is_within(number_.value(), Move::kMin, Move::kMax)) {
    return emit(Problem{ProblemCode::kNumberOutOfRange, Subject::kMove}, out);
  }
  emit(Command{Move{label_, number_.value()}}, out);
}

// Handles the digit after P, R or A%.
bool RhinoParser::feed_digit(std::uint8_t byte, std::vector<Parsed>& out) {
  if (is_space(byte)) {
    consume(byte);
    return true;
  }
  if (!is_digit(byte)) {
    incomplete(out);
    return false;
  }
  consume(byte);
  end_digit(byte - '0', out);
  return true;
}

void RhinoParser::end_digit(int digit, std::vector<Parsed>& out) {
  const bool is_status = mode_ == Mode::kStatus;
  const bool is_allowed =
      is_status ? digit <= SelectStatus::kMax : is_within(digit, 1, SetOutput::kLines);
  if (!is_allowed) {
    const Subject subject = is_status ? Subject::kStatus : Subject::kOutput;
    return emit(Problem{ProblemCode::kNumberOutOfRange, subject}, out);
  }
  if (is_status) return emit(Command{SelectStatus{digit}}, out);
  emit(Command{SetOutput{digit, opener_ == 'P'}}, out);
}

bool RhinoParser::feed_period(std::uint8_t byte, std::vector<Parsed>& out) {
  const bool leads = is_space(byte) && number_.digits == 0;
  if (leads || is_digit(byte)) {
    if (is_digit(byte)) number_.push(byte);
    consume(byte);
    return true;
  }
  if (number_.digits == 0) {
    incomplete(out);
    return false;
  }
  if (is_blank(byte)) consume(byte);
  end_period(out);
  if (is_line_end(byte)) *this = RhinoParser(profile_);
  return is_blank(byte);
}

void RhinoParser::end_period(std::vector<Parsed>& out) {
  if (is_within(number_.magnitude, SetRefreshPeriod::kMin, SetRefreshPeriod::kMax)) {
    return emit(Command{SetRefreshPeriod{number_.magnitude}}, out);
  }
  emit(Problem{ProblemCode::kNumberOutOfRange, Subject::kPeriod}, out);
}

// Handles a byte of the numbers of A!x,y,z! and A*c,r*. The list ends with the byte that started
// it.
bool RhinoParser::feed_list(std::uint8_t byte, std::vector<Parsed>& out) {
  if (byte == static_cast<std::uint8_t>(opener_)) {
    consume(byte);
    emit(list_result(), out);
    return true;
  }
  if (is_line_end(byte)) {
    incomplete(out);
    return false;
  }
  if (is_digit(byte)) {
    list_is_bad_ |= number_.ended;
    number_.push(byte);
  } else if (is_sign(byte)) {
    list_is_bad_ |= number_.sign != 0 || number_.digits > 0 || mode_ == Mode::kCamera;
    number_.sign = static_cast<char>(byte);
  } else if (byte == ',') {
    push_list_value();
  } else if (is_space(byte)) {
    number_.ended = number_.digits > 0;
  } else {
    const auto code =
        mode_ == Mode::kView ? ProblemCode::kBadViewVector : ProblemCode::kBadCameraArgument;
    emit(Problem{code, Subject::kNone}, out);
    skips_numbers_ = true;
    return false;
  }
  consume(byte);
  return true;
}

void RhinoParser::push_list_value() {
  list_is_bad_ |= number_.digits == 0 || list_size_ + 1 >= (mode_ == Mode::kView ? 3 : 2);
  if (!list_is_bad_) list_[list_size_++] = number_.value();
  number_ = {};
}

std::variant<Command, Problem> RhinoParser::list_result() const {
  const bool is_empty =
      list_size_ == 0 && number_.digits == 0 && number_.sign == 0 && !list_is_bad_;
  const bool has_last = number_.digits > 0 && !list_is_bad_;
  const int last = number_.value();
  if (mode_ == Mode::kCamera) {
    if (is_empty) return Command{CameraImage{}};
    if (!has_last) return Problem{ProblemCode::kBadCameraArgument, Subject::kNone};
    if (list_size_ == 0) return Command{CameraRow{last}};
    return Command{CameraPixel{list_[0], last}};
  }
  if (is_empty) return Command{SetViewVector{1, 1, 1}};
  const bool is_whole = has_last && list_size_ == 2;
  const auto is_small = [](int value) {
    return is_within(value, -SetViewVector::kMax, SetViewVector::kMax);
  };
  const bool is_zero = list_[0] == 0 && list_[1] == 0 && last == 0;
  if (!is_whole || !is_small(list_[0]) || !is_small(list_[1]) || !is_small(last) || is_zero)
    return Problem{ProblemCode::kBadViewVector, Subject::kNone};
  return Command{SetViewVector{list_[0], list_[1], last}};
}

// --- Book-keeping.

void RhinoParser::consume(std::uint8_t byte) {
  if (raw_.size == 0) from_ = offset_;
  raw_.push(byte);
  to_ = offset_ + 1;
}

void RhinoParser::emit(std::variant<Command, Problem> what, std::vector<Parsed>& out) {
  out.push_back({from_, to_, raw_, std::move(what)});
  raw_ = {};
  mode_ = Mode::kIdle;
}

void RhinoParser::emit_byte(std::uint8_t byte, std::variant<Command, Problem> what,
                            std::vector<Parsed>& out) {
  consume(byte);
  emit(std::move(what), out);
}

void RhinoParser::junk(std::uint8_t byte, Problem problem, std::vector<Parsed>& out) {
  raw_ = {};
  emit_byte(byte, problem, out);
  skips_numbers_ = true;
}

void RhinoParser::incomplete(std::vector<Parsed>& out) {
  const Subject subject = mode_ == Mode::kOutput   ? Subject::kOutput
                          : mode_ == Mode::kView   ? Subject::kView
                          : mode_ == Mode::kCamera ? Subject::kCamera
                          : mode_ == Mode::kPeriod ? Subject::kPeriod
                                                   : Subject::kStatus;
  emit(Problem{ProblemCode::kIncompleteCommand, subject}, out);
  skips_numbers_ = true;
}

void RhinoParser::open(Mode mode, std::uint8_t byte) {
  consume(byte);
  mode_ = mode;
  number_ = {};
  list_size_ = 0;
  list_ = {};
  list_is_bad_ = false;
}

}  // namespace xr3
