#include "protocol/explain/command_text.hpp"

#include <array>

#include "core/drawing/status_line.hpp"
#include "core/switches.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/rhino_reply.hpp"

namespace xr3 {
namespace {

// --- Commands.

std::string number(int value) { return std::to_string(value); }

/// The table of commands.
struct Commands {
  const wire::Executed& executed;

  CommandText operator()(const Move& move) const {
    const std::string text = std::string("move ") + move.label + " " + signed_number(move.counts);
    return {"move", executed.counter ? text + ", counter " + number(*executed.counter) : text};
  }
  CommandText operator()(const SetSpeed& speed) const {
    return {"set_speed", std::string("speed of ") + speed.label + ": " +
                             number(speed.counts_per_s) + " counts a second"};
  }
  CommandText operator()(const Stop& stop) const {
    return {"stop", std::string("stop ") + stop.label + ", counter 0"};
  }
  CommandText operator()(const QueryError& query) const {
    return {"query_error", std::string("asks how far ") + query.label + " has still to go"};
  }
  CommandText operator()(const QuerySignedError& query) const {
    return {"query_signed_error",
            std::string("asks for the error counter of ") + query.label + " with its sign"};
  }
  CommandText operator()(const QuerySwitch& query) const {
    return {"query_switch", std::string("asks for the microswitch of ") + query.label};
  }
  CommandText operator()(const QuerySwitchesI&) const {
    return {"query_switches_i", "asks for the microswitches of C...H"};
  }
  CommandText operator()(const QuerySwitchesJ&) const {
    return {"query_switches_j", "asks for the microswitches of A and B and for input lines 5...8"};
  }
  CommandText operator()(const QueryInputs&) const {
    return {"query_inputs", "asks for input lines 1...4"};
  }
  CommandText operator()(const SetAuxiliary& set) const {
    constexpr std::array<std::string_view, 4> kCodes = {"auxiliary_1_off", "auxiliary_1_on",
                                                        "auxiliary_2_off", "auxiliary_2_on"};
    const int code = set.port * 2 - 2 + (set.on ? 1 : 0);
    return {kCodes.at(static_cast<std::size_t>(code)),
            "auxiliary port " + number(set.port) + (set.on ? " on" : " off")};
  }
  CommandText operator()(const SetOutput& set) const {
    return {set.high ? "output_high" : "output_low",
            "output " + number(set.line) + (set.high ? " high" : " low")};
  }
  CommandText operator()(const ControllerReset&) const {
    return {"controller_reset",
            "controller reset: counters 0, outputs and ports off, speeds of the robot file; it "
            "does not send the robot home"};
  }
  CommandText operator()(const ToggleDisplay&) const {
    return {"toggle_display", executed.is_on ? "display on" : "display off"};
  }
  CommandText operator()(const SetViewVector& view) const {
    return {"set_view_vector",
            "view along " + number(view.x) + "," + number(view.y) + "," + number(view.z)};
  }
  CommandText operator()(const SoftHome&) const {
    return {"soft_home", "soft home: every joint at its home value, counters 0, no stall"};
  }
  CommandText operator()(const ToggleSimulator&) const {
    if (executed.has_device) {
      return {"toggle_simulator",
              executed.is_on ? "simulator enabled: the device gets no command"
                             : "simulator disabled: commands go to the device from now on"};
    }
    return {"toggle_simulator", executed.is_on
                                    ? "simulator enabled"
                                    : "simulator disabled: only A@ is executed from now on"};
  }
  CommandText operator()(const SetRefreshPeriod& period) const {
    const std::string half = period.half_seconds % 2 == 0 ? "" : ".5";
    return {"set_refresh_period",
            "display redrawn every " + number(period.half_seconds / 2) + half + " s"};
  }
  CommandText operator()(const ToggleErasing&) const {
    return {"toggle_erasing", executed.is_on ? "erasing on: earlier pictures are erased"
                                             : "erasing off: the tool leaves its path"};
  }
  CommandText operator()(const SelectStatus& select) const {
    return {"select_status",
            "status line " + number(select.option) + ": " +
                std::string(kStatusLines.at(static_cast<std::size_t>(select.option)))};
  }
  CommandText operator()(const ToggleFunctionKeys&) const {
    return {"toggle_function_keys", "function keys on or off"};
  }
  CommandText operator()(const CameraImage&) const {
    return {"camera_image", "asks for the camera's whole image"};
  }
  CommandText operator()(const CameraRow& row) const {
    return {"camera_row", "asks for row " + number(row.row) + " of the camera's image"};
  }
  CommandText operator()(const CameraPixel& pixel) const {
    return {"camera_pixel",
            "asks for the pixel in column " + number(pixel.column) + ", row " + number(pixel.row)};
  }
};

// --- Replies.

constexpr int kMaxSevenBits = 127;

void list(std::string& text, const std::string& item) { text += (text.empty() ? "" : ", ") + item; }

template <class C>
concept HasLabel = requires(const C& command) { command.label; };

/// The joint of an inquiry; empty if it has none.
struct LabelOf {
  std::string operator()(const HasLabel auto& command) const { return std::string{command.label}; }
  std::string operator()(const auto&) const { return {}; }
};

std::string label_of(const Command& command) { return std::visit(LabelOf{}, command); }

// Closed switches, from the base outwards.
std::string closed_switches(const SwitchBits& bits, const ReplyContext& context) {
  std::string labels;
  for (int i = ReplyContext::kLabels - 1; i >= 0; --i) {
    const char label = static_cast<char>('A' + i);
    const bool is_closed = (bits.closed & context.masks.at(static_cast<std::size_t>(i))) != 0;
    if (is_closed && is_asked_for(label, bits.inquiry)) list(labels, {label});
  }
  return labels.empty() ? "no microswitch closed" : "microswitches closed: " + labels;
}

// K has lines 1...4 in bits 0...3.
std::string high_inputs(const SwitchBits& bits, const ReplyContext& context) {
  const bool is_k = bits.inquiry == 'K';
  const InputMasks masks = is_k ? InputMasks{1, 2, 4, 8} : input_masks_of(context);
  int line = is_k ? 1 : kFirstInputOfJ;
  std::string high;
  for (const std::uint8_t mask : masks) {
    if ((bits.inputs & mask) != 0) list(high, number(line));
    ++line;
  }
  return high.empty() ? "no input line high" : "input lines high: " + high;
}

/// The table of replies.
struct ReplyTexts {
  const Command& command;
  const ReplyContext& context;

  ReplyText operator()(const NoReply&) const { return {}; }
  ReplyText operator()(const ErrorMagnitude& error) const {
    const std::string text = label_of(command) + ": " + number(error.counts) +
                             (error.counts == 1 ? " count to go" : " counts to go");
    const bool is_cut =
        context.profile == Profile::kMark3 && error.counts + kReplyBase > kMaxSevenBits;
    return {"reply_error", is_cut ? text + ", sent without its top bit" : text};
  }
  ReplyText operator()(const SignedError& error) const {
    return {"reply_signed_error", label_of(command) + ": error counter " + number(error.counts)};
  }
  ReplyText operator()(const SwitchState& state) const {
    return {"reply_switch",
            label_of(command) + ": microswitch " + (state.closed ? "closed" : "open")};
  }
  ReplyText operator()(const SwitchBits& bits) const {
    if (bits.inquiry == 'K') return {"reply_inputs", high_inputs(bits, context)};
    const std::string closed = closed_switches(bits, context);
    if (bits.inquiry == 'I') return {"reply_switches", closed};
    return {"reply_switches", closed + "; " + high_inputs(bits, context)};
  }
  ReplyText operator()(const wire::PictureSize& size) const {
    if (const auto* row = std::get_if<CameraRow>(&command)) {
      return {"reply_row",
              "row " + number(row->row) + " of the image: " + number(size.width) + " pixels"};
    }
    return {"reply_image",
            "image of " + number(size.width) + " x " + number(size.height) + " pixels"};
  }
  ReplyText operator()(const PixelValue& pixel) const {
    const auto& asked = std::get<CameraPixel>(command);
    return {"reply_pixel", "pixel in column " + number(asked.column) + ", row " +
                               number(asked.row) + ": " +
                               (pixel.set ? "1, a block" : "0, no block")};
  }
};

}  // namespace

CommandText command_text(const wire::Executed& executed) {
  return std::visit(Commands{executed}, executed.command);
}

std::string_view code_of(const Command& command) {
  return command_text({command, std::nullopt, false}).code;
}

ReplyText reply_text(const wire::Answered& answered, const ReplyContext& context) {
  return std::visit(ReplyTexts{answered.command, context}, answered.reply);
}

}  // namespace xr3
