#include "protocol/monitor/saved_faults.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "core/faults/effects.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/monitor/message.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

Codec<Fault> whole_fault() {
  Codec<Fault> codec = object(fault_members());
  codec.write = fault_to_json;
  return codec;
}

Members<FaultState> history_members() {
  return {
      required("fault", &FaultState::fault, whole_fault()),
      required("effects", &FaultState::effects, integer<std::uint64_t>(0, monitor::kMaxInteger)),
      optional("bounce_tick", &FaultState::bounce_tick, integer<Tick>(0, monitor::kMaxInteger)),
      required("news_second", &FaultState::news_second, integer<Tick>(0, monitor::kMaxInteger)),
      required("news", &FaultState::news, integer<std::uint32_t>(0, kMaxFaultNews))};
}

bool is_active(const State& state, const FaultState& each) {
  if (traits_of(each.fault.kind).manner == FaultManner::kLasting) return each.is_on;
  return !each.is_spent() && each.fault.covers(state.tick);
}

}  // namespace

Codec<Faults> saved_faults() {
  return object(Members<Faults>{
      required("seed", &Faults::seed, fault_seed()),
      required("all", &Faults::all, list(object(history_members()), 0, kMaxFaults)),
      required("power_cycles", &Faults::power_cycles, integer<std::uint32_t>(0, UINT32_MAX)),
      required("slipped", &Faults::slipped, integer<MotorBits>(0, UINT8_MAX))});
}

void check_saved_faults(const Faults& faults, const std::string& pointer, Reading& reading) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < faults.all.size(); ++i) {
    const std::string place = child_pointer(pointer + "/all", i) + "/fault";
    check_fault(faults.all[i].fault, place, "", reading);
    if (names.insert(faults.all[i].fault.name).second || !reading.is_sound(place)) continue;
    reading.refuse(place + "/name", "\"" + faults.all[i].fault.name + "\", a duplicate",
                   "a name that no other fault has");
  }
}

void add_fault_list(const State& state, Json& value) {
  Json list = Json::array();
  for (const FaultState& each : state.faults.all) {
    Json entry = fault_to_json(each.fault);
    entry["effects"] = each.effects;
    entry["active"] = is_active(state, each);
    list.push_back(std::move(entry));
  }
  value["seed"] = state.faults.seed;
  value["faults"] = std::move(list);
}

}  // namespace xr3
