#include "protocol/monitor/calls/key.hpp"

#include <utility>
#include <vector>

namespace xr3::monitor {
namespace {

enum class Function : std::uint8_t {
  kDisplay,
  kView,
  kHome,
  kStatus,
  kEnabled,
  kFunctionKeys,
  kPeriod,
  kPath,
};

data::Codec<Function> function() {
  return data::choice<Function>({{"display", Function::kDisplay},
                                 {"view", Function::kView},
                                 {"home", Function::kHome},
                                 {"status", Function::kStatus},
                                 {"enabled", Function::kEnabled},
                                 {"function_keys", Function::kFunctionKeys},
                                 {"period", Function::kPeriod},
                                 {"path", Function::kPath}});
}

SetViewVector read_view(ArgsReader& args) {
  const auto xyz =
      args.coded("value",
                 data::list(data::whole_number(-SetViewVector::kMax, SetViewVector::kMax), 3, 3))
          .value_or(std::vector<int>{1, 1, 1});
  if (xyz == std::vector<int>{0, 0, 0}) args.refuse("value", "a view that is not 0, 0, 0");
  return {xyz[0], xyz[1], xyz[2]};
}

Command without_value(ArgsReader& args, const Command& command) {
  if (args.ask("value")) args.refuse("value", "nothing: this function takes no value");
  return command;
}

Command command_of(Function function, ArgsReader& args) {
  switch (function) {
    case Function::kDisplay: return without_value(args, ToggleDisplay{});
    case Function::kView: return read_view(args);
    case Function::kHome: return without_value(args, SoftHome{});
    case Function::kStatus:
      return SelectStatus{
          static_cast<int>(args.integer("value", 0, SelectStatus::kMax).value_or(0))};
    case Function::kEnabled: return without_value(args, ToggleSimulator{});
    case Function::kFunctionKeys: return without_value(args, ToggleFunctionKeys{});
    case Function::kPeriod:
      return SetRefreshPeriod{static_cast<int>(
          args.integer("value", SetRefreshPeriod::kMin, SetRefreshPeriod::kMax).value_or(1))};
    case Function::kPath: return without_value(args, ToggleErasing{});
  }
  return ToggleDisplay{};
}

/// The arguments of `key`, for each command that it has.
struct KeyWriter {
  Json operator()(const ToggleDisplay&) const { return key("display"); }
  Json operator()(const SetViewVector& view) const {
    return key("view", Json{view.x, view.y, view.z});
  }
  Json operator()(const SoftHome&) const { return key("home"); }
  Json operator()(const SelectStatus& status) const { return key("status", status.option); }
  Json operator()(const ToggleSimulator&) const { return key("enabled"); }
  Json operator()(const ToggleFunctionKeys&) const { return key("function_keys"); }
  Json operator()(const SetRefreshPeriod& period) const {
    return key("period", period.half_seconds);
  }
  Json operator()(const ToggleErasing&) const { return key("path"); }
  template <class Other>
  Json operator()(const Other&) const {
    return key("");  // no reader makes such a call
  }

 private:
  static Json key(const char* function, Json value = {}) {
    Json args = {{"function", function}};
    if (!value.is_null()) args["value"] = std::move(value);
    return args;
  }
};

}  // namespace

CallValue read_key(ArgsReader& args) {
  const auto chosen = args.coded("function", function());
  args.ask("value", Presence::kOptional,
           "of view: [x, y, z], whole numbers -9...9, not all 0; of status: 0...6; of period: "
           "1...255 half seconds; of the others: nothing");
  if (!chosen) return call::Key{ToggleDisplay{}};
  return call::Key{command_of(*chosen, args)};
}

Json write_key(const call::Key& key) { return std::visit(KeyWriter{}, key.command); }

}  // namespace xr3::monitor
