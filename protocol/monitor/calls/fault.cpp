// The calls on faults: `fault_set`, `fault_list` and `fault_clear`.
#include <utility>

#include "protocol/files/faults.hpp"
#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

CallValue read_fault_set(ArgsReader& args) {
  call::SetFault set;
  const JsonValue value = document(args, "fault", Presence::kRequired,
                                   "an object in the form of a fault file's faults");
  set.seed = args.coded("seed", data::fault_seed(), Presence::kOptional);
  if (!value) return set;
  data::Reading reading(value, data::Unit::kMm);
  set.fault = read_fault(reading).value_or(Fault{});
  args.findings().add_errors(reading, "");
  return set;
}

Json write_fault_set(const call::SetFault& set) {
  Json args = {{"fault", fault_to_json(set.fault)}};
  if (set.seed) args["seed"] = *set.seed;
  return args;
}

CallValue read_fault_clear(ArgsReader& args) {
  auto name = args.coded("name", data::text(1, Fault::kMaxName), Presence::kOptional);
  return call::ClearFault{std::move(name).value_or("")};
}

Json write_fault_clear(const call::ClearFault& clear) {
  return clear.name.empty() ? Json::object() : Json{{"name", clear.name}};
}

constexpr CallForm kFaultCalls[] = {
    {"fault_set", "Adds a fault, or replaces the one with its name.", read_fault_set,
     write_as<call::SetFault, write_fault_set>},
    {"fault_list", "Lists the faults and their effects so far.", read_nothing<ListFaults>},
    {"fault_clear", "Removes a fault, or all.", read_fault_clear,
     write_as<call::ClearFault, write_fault_clear>},
};

}  // namespace

CallForms fault_calls() { return kFaultCalls; }

}  // namespace xr3::monitor
