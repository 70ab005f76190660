#include "protocol/explain/fault_text.hpp"

#include <array>

namespace xr3 {
namespace {

/// The name of a kind, and what such a fault does from its begin on, or has done. `#` stands for
/// the offset of the byte or the count of the motor, `@` for the joint.
struct FaultText {
  std::string_view code;
  std::string_view effect;
};

constexpr std::array<FaultText, kFaultKinds> kFaultTexts = {{
    {"byte_dropped", "byte # is lost"},
    {"byte_flipped", "a bit of byte # is inverted"},
    {"byte_doubled", "byte # arrives twice"},
    {"stray_byte", "a stray byte arrives as the line opens"},
    {"parity_error", "byte # arrives with a parity error"},
    {"wrong_baud", "byte # is garbled, as by another baud rate"},
    {"wrong_parity", "byte # is read without its parity"},
    {"reply_lost", "the reply at byte # is lost"},
    {"reply_delayed", "the reply at byte # is delayed"},
    {"reply_batched", "replies wait for the next batch"},
    {"xoff_stall", "replies wait: XOFF"},
    {"line_disconnected", "a line is disconnected"},
    {"power_cycle", "the controller was without power; its counters are 0"},
    {"motor_stuck", "the motor of @ is stuck"},
    {"motor_slow", "the motor of @ is slow"},
    {"encoder_slip", "the encoder of @ misses a count at #"},
    {"grip_slip", "the block slips out of the jaws"},
    {"switch_stuck_open", "the microswitch of @ is stuck open"},
    {"switch_stuck_closed", "the microswitch of @ is stuck closed"},
    {"switch_bouncing", "the microswitch of @ bounces"},
    {"camera_noise", "the camera's image has noise"},
    {"camera_dead_row", "a row of the camera's image is dead"},
    {"camera_offset", "the camera's lens is displaced"},
}};
static_assert(!kFaultTexts.back().code.empty(), "each kind has a row");

const FaultText& fault_text(FaultKind kind) { return kFaultTexts[static_cast<std::size_t>(kind)]; }

std::string effect_text(const FaultNews& news) {
  std::string text;
  for (const char c : fault_text(news.kind).effect)
    text += c == '#' ? std::to_string(news.at) : std::string(1, c == '@' ? news.label : c);
  return text;
}

}  // namespace

std::string_view code_of(FaultKind kind) { return fault_text(kind).code; }

std::string_view code_of(FaultPhase phase) {
  switch (phase) {
    case FaultPhase::kSet: return "set";
    case FaultPhase::kCleared: return "cleared";
    case FaultPhase::kBegan: return "began";
    case FaultPhase::kEnded: return "ended";
    case FaultPhase::kEffect: return "effect";
  }
  return "";
}

std::string text_of(const FaultNews& news) {
  const std::string name = "fault " + news.fault;
  switch (news.phase) {
    case FaultPhase::kSet: return name + " is set: " + std::string(code_of(news.kind));
    case FaultPhase::kCleared: return name + " is cleared";
    case FaultPhase::kEnded: return name + " has ended";
    case FaultPhase::kBegan:
    case FaultPhase::kEffect: break;
  }
  return name + ": " + effect_text(news);
}

}  // namespace xr3
