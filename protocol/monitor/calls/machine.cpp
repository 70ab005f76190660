// The calls on the machine: `home`, `key`, `device_stop`, `mirror_align` and `input`.
#include "protocol/monitor/calls/key.hpp"

namespace xr3::monitor {
namespace {

CallValue read_input(ArgsReader& args) {
  const auto input = args.integer("input", 1, 8).value_or(1);
  return call::SetInput{static_cast<int>(input),
                        args.coded("value", data::boolean()).value_or(false)};
}

Json write_input(const call::SetInput& set) { return {{"input", set.input}, {"value", set.value}}; }

constexpr CallForm kMachineCalls[] = {
    {"home", "Moves the robot to its soft home, as A$ does.", read_nothing<call::Home>,
     write_nothing<call::Home>},
    {"key", "Runs a function of the controller's command mode.", read_key,
     write_as<call::Key, write_key>},
    {"device_stop", "Stops all joints of the physical controller.", read_nothing<call::StopDevice>,
     write_nothing<call::StopDevice>},
    {"mirror_align", "Moves the simulation to its soft home, where the physical arm has been put.",
     read_nothing<call::AlignMirror>, write_nothing<call::AlignMirror>},
    {"input", "Sets an input line high or low.", read_input, write_as<call::SetInput, write_input>},
};

}  // namespace

CallForms machine_calls() { return kMachineCalls; }

}  // namespace xr3::monitor
