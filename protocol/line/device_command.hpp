// Commands as a physical Mark III controller receives them.
#pragma once

#include <optional>
#include <string>

#include "core/command.hpp"

namespace xr3 {

/// The bytes of one whole command. Those of an inquiry are answered by one byte.
struct DeviceCommand {
  std::string bytes;
  bool is_inquiry = false;
  bool operator==(const DeviceCommand&) const = default;
};

/// The bytes of a command; nullopt if only the simulator has it. The bytes name the joint, whatever
/// was selected before, and a number ends with a carriage return.
std::optional<DeviceCommand> for_device(const Command& command);

/// The bytes that stop every joint that a Mark III can have: `AX` to `HX`.
std::string stop_all_joints();

}  // namespace xr3
