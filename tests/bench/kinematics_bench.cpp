// Cost of the kinematics: the tip for every decision, the frames for every picture.
#include <benchmark/benchmark.h>

#include "core/kinematics.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

Positions bent(const Model& model) {
  return test::positions_at(model, {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}});
}

template <auto function>
void of_the_rhino(benchmark::State& state) {
  const ModelPtr model = test::rhino();
  Positions at = bent(*model);
  for (auto _ : state) {
    benchmark::DoNotOptimize(at);
    benchmark::DoNotOptimize(function(*model, at));
  }
}
BENCHMARK(of_the_rhino<tool_tip>)->Name("tool_tip");
BENCHMARK(of_the_rhino<tool_transform>)->Name("tool_transform");
BENCHMARK(of_the_rhino<base_transforms>)->Name("base_transforms");
BENCHMARK(of_the_rhino<tool_configuration>)->Name("tool_configuration");

void make_a_model(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(test::model_of(test::robot_named("rhino-xr3")));
}
BENCHMARK(make_a_model)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace xr3
