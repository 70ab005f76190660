#include "protocol/explain/fault_text.hpp"

namespace xr3 {
namespace {

std::string byte_text(const FaultNews& news) { return "byte " + std::to_string(news.at); }

std::string joint_text(const FaultNews& news) { return std::string(1, news.label); }

/// What the fault does from its begin on, or has done.
std::string effect_text(const FaultNews& news) {
  switch (news.kind) {
    case FaultKind::kByteDropped: return byte_text(news) + " is lost";
    case FaultKind::kByteFlipped: return "a bit of " + byte_text(news) + " is inverted";
    case FaultKind::kByteDoubled: return byte_text(news) + " arrives twice";
    case FaultKind::kStrayByte: return "a stray byte arrives as the line opens";
    case FaultKind::kParityError: return byte_text(news) + " arrives with a parity error";
    case FaultKind::kWrongBaud: return byte_text(news) + " is garbled, as by another baud rate";
    case FaultKind::kWrongParity: return byte_text(news) + " is read without its parity";
    case FaultKind::kReplyLost: return "the reply at " + byte_text(news) + " is lost";
    case FaultKind::kReplyDelayed: return "the reply at " + byte_text(news) + " is delayed";
    case FaultKind::kReplyBatched: return "replies wait for the next batch";
    case FaultKind::kXoffStall: return "replies wait: XOFF";
    case FaultKind::kLineDisconnected: return "a line is disconnected";
    case FaultKind::kPowerCycle: return "the controller was without power; its counters are 0";
    case FaultKind::kMotorStuck: return "the motor of " + joint_text(news) + " is stuck";
    case FaultKind::kMotorSlow: return "the motor of " + joint_text(news) + " is slow";
    case FaultKind::kEncoderSlip:
      return "the encoder of " + joint_text(news) + " misses a count at " + std::to_string(news.at);
    case FaultKind::kGripSlip: return "the block slips out of the jaws";
    case FaultKind::kSwitchStuckOpen:
      return "the microswitch of " + joint_text(news) + " is stuck open";
    case FaultKind::kSwitchStuckClosed:
      return "the microswitch of " + joint_text(news) + " is stuck closed";
    case FaultKind::kSwitchBouncing: return "the microswitch of " + joint_text(news) + " bounces";
    case FaultKind::kCameraNoise: return "the camera's image has noise";
    case FaultKind::kCameraDeadRow: return "a row of the camera's image is dead";
    case FaultKind::kCameraOffset: return "the camera's lens is displaced";
  }
  return "";
}

}  // namespace

std::string_view code_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::kByteDropped: return "byte_dropped";
    case FaultKind::kByteFlipped: return "byte_flipped";
    case FaultKind::kByteDoubled: return "byte_doubled";
    case FaultKind::kStrayByte: return "stray_byte";
    case FaultKind::kParityError: return "parity_error";
    case FaultKind::kWrongBaud: return "wrong_baud";
    case FaultKind::kWrongParity: return "wrong_parity";
    case FaultKind::kReplyLost: return "reply_lost";
    case FaultKind::kReplyDelayed: return "reply_delayed";
    case FaultKind::kReplyBatched: return "reply_batched";
    case FaultKind::kXoffStall: return "xoff_stall";
    case FaultKind::kLineDisconnected: return "line_disconnected";
    case FaultKind::kPowerCycle: return "power_cycle";
    case FaultKind::kMotorStuck: return "motor_stuck";
    case FaultKind::kMotorSlow: return "motor_slow";
    case FaultKind::kEncoderSlip: return "encoder_slip";
    case FaultKind::kGripSlip: return "grip_slip";
    case FaultKind::kSwitchStuckOpen: return "switch_stuck_open";
    case FaultKind::kSwitchStuckClosed: return "switch_stuck_closed";
    case FaultKind::kSwitchBouncing: return "switch_bouncing";
    case FaultKind::kCameraNoise: return "camera_noise";
    case FaultKind::kCameraDeadRow: return "camera_dead_row";
    case FaultKind::kCameraOffset: return "camera_offset";
  }
  return "";
}

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
