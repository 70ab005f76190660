// Speed of a cell: simulated time over wall time, with every motor running and jaws, tip, switches
// and limits checked at every count. The main result is the counter x_real_time.
#include <benchmark/benchmark.h>

#include <array>

#include "core/simulation.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr Tick kSlice = 50;
constexpr int kAlmostThere = 20;  // more counts than any motor makes in a slice
constexpr int kThereAndBack = 100;

// Every motor moves back and forth between about -50 and +50 counts, and is reversed before it
// arrives.
void keep_running(Simulation& simulation) {
  for (int i = 0; i < simulation.model().motor_count(); ++i) {
    const MotorState& motor = simulation.state().motor(i);
    if (std::abs(motor.error) >= kAlmostThere) continue;
    const Counts aim = motor.count + motor.error;
    const bool back = i == simulation.model().tool_index() ? aim >= 0 : aim > 0;
    simulation.execute(Move{simulation.model().motor(i).drive.label,
                            back ? -kThereAndBack / 2 : kThereAndBack / 2});
  }
}

Simulation running_simulation(int speed) {
  Simulation simulation(std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper));
  for (int i = 0; speed > 0 && i < simulation.model().motor_count(); ++i) {
    simulation.execute(SetSpeed{simulation.model().motor(i).drive.label, speed});
  }
  return simulation;
}

void report(benchmark::State& state, Tick ticks) {
  const auto count = static_cast<double>(ticks);
  state.counters["ticks"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
  state.counters["x_real_time"] = benchmark::Counter(count / kTickHz, benchmark::Counter::kIsRate);
}

// Argument: the speed of all motors in counts per second; 0: the speeds of the robot file.
void six_motors(benchmark::State& state) {
  Simulation simulation = running_simulation(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    keep_running(simulation);
    simulation.advance_to(simulation.tick() + kSlice);
    simulation.take_events();
  }
  if (simulation.is_at_rest()) state.SkipWithError("the robot came to rest");
  report(state, simulation.tick());
}
BENCHMARK(six_motors)->Arg(0)->Arg(255);

void one_motor(benchmark::State& state) {
  Simulation simulation = running_simulation(0);
  for (auto _ : state) {
    const MotorState& base = simulation.state().motor(0);
    if (base.error == 0) simulation.execute(Move{'F', base.count > 0 ? -100 : 100});
    simulation.advance_to(simulation.tick() + kSlice);
    simulation.take_events();
  }
  report(state, simulation.tick());
}
BENCHMARK(one_motor);

// The same tick by tick: the cost of a tick if none is skipped.
void six_motors_tick_by_tick(benchmark::State& state) {
  Simulation simulation = running_simulation(0);
  for (auto _ : state) {
    keep_running(simulation);
    for (Tick i = 0; i < kSlice; ++i) simulation.advance_to(simulation.tick() + 1);
    simulation.take_events();
  }
  report(state, simulation.tick());
}
BENCHMARK(six_motors_tick_by_tick);

void a_month_at_rest(benchmark::State& state) {
  constexpr Tick kMonth = Tick{31} * 86'400 * kTickHz;
  Simulation simulation = running_simulation(0);
  for (auto _ : state) {
    simulation.advance_to(simulation.tick() + kMonth);
    benchmark::DoNotOptimize(simulation.tick());
  }
}
BENCHMARK(a_month_at_rest)->Iterations(100'000);

void copy_a_state(benchmark::State& state) {
  const Simulation simulation = running_simulation(0);
  for (auto _ : state) {
    State copy = simulation.state();
    benchmark::DoNotOptimize(copy);
  }
}
BENCHMARK(copy_a_state);

}  // namespace
}  // namespace xr3
