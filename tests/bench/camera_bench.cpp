// Cost of a camera image: a hundred blocks at 640 x 480 pixels, both projections, and one row of
// it.
#include <benchmark/benchmark.h>

#include <memory>

#include "core/camera.hpp"
#include "core/home.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

const Model& hundred_blocks(Projection projection, int width, int height) {
  static std::shared_ptr<const Model> model;
  const std::string data = XR3_SOURCE_DIR "/data/";
  const DataFile robot = read_file(data + "robots/rhino-xr3.json");
  const DataFile file = read_file(data + "workcells/rhino-hundred.json");
  Workcell workcell = load_workcell(file.text, file.path);
  workcell.camera->pixels_x = width;
  workcell.camera->pixels_y = height;
  workcell.camera->projection = projection;
  model =
      std::make_shared<const Model>(load_robot(robot.text, robot.path), workcell, Profile::kPaper);
  return *model;
}

void camera_image_of_a_hundred_blocks(benchmark::State& run, Projection projection, int width,
                                      int height) {
  const Model& model = hundred_blocks(projection, width, height);
  const State state = initial_state(model);
  for (auto _ : run) benchmark::DoNotOptimize(camera_image(model, state));
}

void camera_row_of_a_hundred_blocks(benchmark::State& run) {
  const Model& model = hundred_blocks(Projection::kOrthographic, 640, 480);
  const State state = initial_state(model);
  for (auto _ : run) benchmark::DoNotOptimize(camera_row(model, state, 240));
}

BENCHMARK_CAPTURE(camera_image_of_a_hundred_blocks, orthographic_640x480, Projection::kOrthographic,
                  640, 480)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(camera_image_of_a_hundred_blocks, perspective_640x480, Projection::kPerspective,
                  640, 480)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(camera_image_of_a_hundred_blocks, orthographic_1000x1000,
                  Projection::kOrthographic, 1000, 1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(camera_row_of_a_hundred_blocks)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace xr3
