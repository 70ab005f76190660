// The calls on simulated time: `pause`, `resume`, `freeze`, `unfreeze`, `rate`, `step`, `run_until`
// and `reset`.
#include <cmath>

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

CallValue read_rate(ArgsReader& args) {
  const double factor = args.number("factor", 0.001, 100'000).value_or(1);
  return call::SetRate{{std::llround(factor * 1e6)}};
}

Json write_rate(const call::SetRate& rate) {
  return {{"factor", static_cast<double>(rate.rate.millionths) / 1e6}};
}

CallValue read_step(ArgsReader& args) {
  return call::Step{args.integer("ticks", 0, kMaxInteger).value_or(0)};
}

Json write_step(const call::Step& step) { return {{"ticks", step.ticks}}; }

CallValue read_run_until(ArgsReader& args) {
  call::RunUntil run;
  const JsonValue idle = args.ask("idle", Presence::kOptional, "true, or else a tick");
  run.tick = args.integer("tick", 0, kMaxInteger, Presence::kOptional);
  const bool has_tick = static_cast<bool>(args.ask("tick"));
  if (idle && (has_tick || !idle.is_true())) args.refuse("idle", "true, and then no tick");
  if (!idle && !has_tick) args.refuse("idle", "true, or else a tick");
  run.max_ticks = args.integer("max_ticks", 0, kMaxInteger).value_or(0);
  return run;
}

Json write_run_until(const call::RunUntil& run) {
  Json args = run.tick ? Json{{"tick", *run.tick}} : Json{{"idle", true}};
  args["max_ticks"] = run.max_ticks;
  return args;
}

constexpr CallForm kTimeCalls[] = {
    {"pause", "Stops simulated time; the clock is then manual.", read_nothing<call::Pause>,
     write_nothing<call::Pause>},
    {"resume", "Makes simulated time follow the wall clock, or the byte clock, again.",
     read_nothing<call::Resume>, write_nothing<call::Resume>},
    {"freeze", "Stops simulated time until unfreeze; replies then leave after 4 seconds.",
     read_nothing<call::Freeze>, write_nothing<call::Freeze>},
    {"unfreeze", "Lets simulated time pass again as before freeze.", read_nothing<call::Unfreeze>,
     write_nothing<call::Unfreeze>},
    {"rate", "Sets the number of simulated seconds per second.", read_rate,
     write_as<call::SetRate, write_rate>},
    {"step", "Advances simulated time by a number of ticks; not with a real clock.", read_step,
     write_as<call::Step, write_step>},
    {"run_until",
     "Advances simulated time until nothing moves or to a tick; not with a real clock.",
     read_run_until, write_as<call::RunUntil, write_run_until>},
    {"reset", "Begins a new epoch with the initial state of the files.", read_nothing<call::Reset>,
     write_nothing<call::Reset>},
};

}  // namespace

CallForms time_calls() { return kTimeCalls; }

}  // namespace xr3::monitor
