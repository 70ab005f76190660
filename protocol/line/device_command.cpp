#include "protocol/line/device_command.hpp"

#include <variant>

namespace xr3 {
namespace {

/// The table of the commands that a Mark III has.
struct ForDevice {
  using Result = std::optional<DeviceCommand>;

  Result operator()(const Move& c) const {
    const char* sign = c.counts < 0 ? "" : "+";
    return DeviceCommand{std::string{c.label} + sign + std::to_string(c.counts) + "\r"};
  }
  Result operator()(const Stop& c) const { return DeviceCommand{{c.label, 'X'}}; }
  Result operator()(const QueryError& c) const { return DeviceCommand{{c.label, '?'}, true}; }
  Result operator()(const QuerySwitchesI&) const { return DeviceCommand{"I", true}; }
  Result operator()(const QuerySwitchesJ&) const { return DeviceCommand{"J", true}; }
  Result operator()(const QueryInputs&) const { return DeviceCommand{"K", true}; }
  Result operator()(const SetAuxiliary& c) const {
    if (c.port == 1) return DeviceCommand{c.on ? "L" : "M"};
    return DeviceCommand{c.on ? "N" : "O"};
  }
  Result operator()(const SetOutput& c) const {
    return DeviceCommand{(c.high ? "P" : "R") + std::to_string(c.line) + "\r"};
  }
  Result operator()(const ControllerReset&) const { return DeviceCommand{"Q"}; }
  template <class SimulatorOnly>
  Result operator()(const SimulatorOnly&) const {
    return std::nullopt;
  }
};

}  // namespace

std::optional<DeviceCommand> for_device(const Command& command) {
  return std::visit(ForDevice{}, command);
}

std::string stop_all_joints() {
  std::string all;
  for (char label = 'A'; label <= 'H'; ++label) all += {label, 'X'};
  return all;
}

}  // namespace xr3
