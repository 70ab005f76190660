#include "protocol/explain/reply_words.hpp"

#include "core/switches.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/rhino_reply.hpp"

namespace xr3 {
namespace {

constexpr int kMaxSevenBits = 127;

std::string number(int value) { return std::to_string(value); }

void list(std::string& words, const std::string& item) {
  words += (words.empty() ? "" : ", ") + item;
}

/// The joint of an inquiry; empty if it has none.
std::string label_of(const Command& command) {
  if (const auto* query = std::get_if<QueryError>(&command)) return {query->label};
  if (const auto* query = std::get_if<QuerySignedError>(&command)) return {query->label};
  if (const auto* query = std::get_if<QuerySwitch>(&command)) return {query->label};
  return "";
}

std::string closed_switches(const SwitchBits& bits, const Model& model) {
  std::string labels;
  for (int i = 0; i < model.motor_count(); ++i) {
    const char label = model.motor(i).drive.label;
    const bool is_closed = (bits.closed & model.motor(i).microswitch.mask) != 0;
    if (is_closed && is_asked_for(label, bits.inquiry)) list(labels, {label});
  }
  return labels.empty() ? "no microswitch closed" : "microswitches closed: " + labels;
}

// K carries lines 1...4 in bits 0...3, J lines 5...8 in bits 2...5.
std::string high_inputs(const SwitchBits& bits) {
  const unsigned inputs = bits.inputs;
  const unsigned lines = bits.inquiry == 'K' ? inputs : inputs >> 2U << 4U;
  std::string high;
  for (unsigned i = 0; i < 8; ++i) {
    if ((lines >> i & 1U) != 0) list(high, number(static_cast<int>(i) + 1));
  }
  return high.empty() ? "no input line high" : "input lines high: " + high;
}

struct Namer {
  const Command& command;

  std::string_view operator()(const ErrorMagnitude&) const { return "reply_error"; }
  std::string_view operator()(const SignedError&) const { return "reply_signed_error"; }
  std::string_view operator()(const SwitchState&) const { return "reply_switch"; }
  std::string_view operator()(const SwitchBits& bits) const {
    return bits.inquiry == 'K' ? "reply_inputs" : "reply_switches";
  }
  std::string_view operator()(const wire::PictureSize&) const {
    return std::holds_alternative<CameraRow>(command) ? "reply_row" : "reply_image";
  }
  std::string_view operator()(const PixelValue&) const { return "reply_pixel"; }
};

struct Describer {
  const Command& command;
  const Model& model;

  std::string operator()(const ErrorMagnitude& error) const {
    const std::string words = label_of(command) + ": " + number(error.counts) +
                              (error.counts == 1 ? " count to go" : " counts to go");
    const bool is_cut =
        model.profile() == Profile::kMark3 && error.counts + kReplyBase > kMaxSevenBits;
    return is_cut ? words + ", sent without its top bit" : words;
  }
  std::string operator()(const SignedError& error) const {
    return label_of(command) + ": error counter " + number(error.counts);
  }
  std::string operator()(const SwitchState& state) const {
    return label_of(command) + ": microswitch " + (state.closed ? "closed" : "open");
  }
  std::string operator()(const SwitchBits& bits) const {
    if (bits.inquiry == 'K') return high_inputs(bits);
    const std::string closed = closed_switches(bits, model);
    return bits.inquiry == 'I' ? closed : closed + "; " + high_inputs(bits);
  }
  std::string operator()(const wire::PictureSize& size) const {
    if (const auto* row = std::get_if<CameraRow>(&command)) {
      return "row " + number(row->row) + " of the image: " + number(size.width) + " pixels";
    }
    return "image of " + number(size.width) + " x " + number(size.height) + " pixels";
  }
  std::string operator()(const PixelValue& pixel) const {
    const auto* asked = std::get_if<CameraPixel>(&command);
    if (asked == nullptr) return "";
    return "pixel in column " + number(asked->column) + ", row " + number(asked->row) + ": " +
           (pixel.set ? "1, a block" : "0, no block");
  }
};

}  // namespace

std::string_view code_of(const wire::Answered& answered) {
  return std::visit(Namer{answered.command}, answered.reply);
}

std::string describe(const wire::Answered& answered, const Model& model) {
  return std::visit(Describer{answered.command, model}, answered.reply);
}

}  // namespace xr3
