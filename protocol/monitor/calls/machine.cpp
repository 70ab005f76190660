// The calls on the machine and on those who look at it: `home`, `key`, `device_stop`,
// `mirror_align`, `input` and `notice`.
#include <utility>
#include <vector>

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

/// The functions of the controller's command mode (paper, Table IV), each with its command.
const std::vector<std::pair<std::string, Command>>& key_functions() {
  static const std::vector<std::pair<std::string, Command>> functions = {
      {"display", ToggleDisplay{}},
      {"view", SetViewVector{1, 1, 1}},
      {"home", SoftHome{}},
      {"status", SelectStatus{0}},
      {"enabled", ToggleSimulator{}},
      {"function_keys", ToggleFunctionKeys{}},
      {"period", SetRefreshPeriod{1}},
      {"path", ToggleErasing{}}};
  return functions;
}

/// Reads the value of a function into its command.
struct KeyArguments {
  ArgsReader& args;

  Command operator()(const SetViewVector&) const {
    const auto range = data::whole_number(-SetViewVector::kMax, SetViewVector::kMax);
    const auto xyz =
        args.coded("value", data::list(range, 3, 3)).value_or(std::vector<int>{1, 1, 1});
    if (xyz == std::vector<int>{0, 0, 0}) args.refuse("value", "a view that is not 0, 0, 0");
    return SetViewVector{xyz[0], xyz[1], xyz[2]};
  }
  Command operator()(const SelectStatus&) const {
    return SelectStatus{static_cast<int>(args.integer("value", 0, SelectStatus::kMax).value_or(0))};
  }
  Command operator()(const SetRefreshPeriod&) const {
    return SetRefreshPeriod{static_cast<int>(
        args.integer("value", SetRefreshPeriod::kMin, SetRefreshPeriod::kMax).value_or(1))};
  }
  template <class Other>
  Command operator()(const Other& command) const {
    if (args.ask("value")) args.refuse("value", "nothing: this function takes no value");
    return command;
  }
};

CallValue read_key(ArgsReader& args) {
  const auto chosen = args.coded("function", data::choice(key_functions()));
  args.ask("value", Presence::kOptional,
           "of view: [x, y, z], whole numbers -9...9, not all 0; of status: 0...6; of period: "
           "1...255 half seconds; of the others: nothing");
  if (!chosen) return call::Key{ToggleDisplay{}};
  return call::Key{std::visit(KeyArguments{args}, *chosen)};
}

/// The value of a function; JSON null if it has none.
struct KeyValue {
  Json operator()(const SetViewVector& view) const { return Json::array({view.x, view.y, view.z}); }
  Json operator()(const SelectStatus& status) const { return status.option; }
  Json operator()(const SetRefreshPeriod& period) const { return period.half_seconds; }
  template <class Other>
  Json operator()(const Other&) const {
    return nullptr;
  }
};

Json write_key(const call::Key& key) {
  Json args = Json::object();
  for (const auto& [name, command] : key_functions())
    if (command.index() == key.command.index()) args["function"] = name;
  Json value = std::visit(KeyValue{}, key.command);
  if (!value.is_null()) args["value"] = std::move(value);
  return args;
}

CallValue read_input(ArgsReader& args) {
  const auto input = args.integer("input", 1, 8).value_or(1);
  return call::SetInput{static_cast<int>(input),
                        args.coded("value", data::boolean()).value_or(false)};
}

Json write_input(const call::SetInput& set) { return {{"input", set.input}, {"value", set.value}}; }

CallValue read_notice(ArgsReader& args) {
  return call::SayNotice{args.coded("text", data::text(1, call::SayNotice::kMaxText)).value_or("")};
}

Json write_notice(const call::SayNotice& notice) { return {{"text", notice.text}}; }

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
    {"notice", "Shows a text on the pages of the robot, for its student.", read_notice,
     write_as<call::SayNotice, write_notice>},
};

}  // namespace

CallForms machine_calls() { return kMachineCalls; }

}  // namespace xr3::monitor
