// Cost of the monitor: a record of a line at every read, and the messages for subscribers.
#include <benchmark/benchmark.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/home.hpp"
#include "protocol/monitor/display.hpp"
#include "protocol/monitor/event.hpp"
#include "protocol/monitor/image.hpp"
#include "protocol/monitor/model.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/models.hpp"
#include "tests/support/tap.hpp"

namespace xr3 {
namespace {

/// A hundred blocks in the field of a camera of 640 x 480 pixels.
const Model& hundred() {
  static const Model model = [] {
    Workcell workcell = test::workcell_named("rhino-hundred");
    workcell.camera->pixels_x = 640;
    workcell.camera->pixels_y = 480;
    return Model(test::robot_named("rhino-xr3"), workcell, Profile::kPaper);
  }();
  return model;
}

/// The exchanges of one read, recorded repeatedly into the same ring.
struct Read {
  Simulation simulation{test::rhino()};
  RhinoEndpoint endpoint{Profile::kPaper};
  std::string replies;
  std::vector<Exchange> exchanges;
  std::vector<wire::Item> answers;
  std::vector<WireRecord> ring = std::vector<WireRecord>(1024);

  explicit Read(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      test::feed(endpoint, static_cast<std::uint8_t>(bytes[i]), i, simulation, replies, exchanges);
    }
    if (!replies.empty()) answers.push_back({0, replies.size(), answer_of(exchanges.back())});
  }
};

void record_a_read(benchmark::State& state, const std::string& bytes) {
  Read read(bytes);
  std::size_t next = 0;
  for (auto _ : state) {
    WireRecord& in = read.ring[next++ % read.ring.size()];
    fill_in(in, {0, 1, 1, 0}, bytes, TelnetFilter(), read.exchanges, read.simulation);
    WireRecord& out = read.ring[next++ % read.ring.size()];
    fill_out(out, {0, 1, 1, 0}, read.replies, read.answers);
    benchmark::DoNotOptimize(out);
  }
}
BENCHMARK_CAPTURE(record_a_read, inquiry, std::string("E?"));
BENCHMARK_CAPTURE(record_a_read, move, std::string("E+5\r\n"));
BENCHMARK_CAPTURE(record_a_read, inquiries_64, [] {
  std::string bytes;
  for (int i = 0; i < 32; ++i) bytes += "E?";
  return bytes;
}());
BENCHMARK_CAPTURE(record_a_read, junk_64, std::string(64, '#'));

void line_json(benchmark::State& state) {
  test::Tap tap(test::rhino());
  tap.send("E+5\r");
  for (auto _ : state) {
    benchmark::DoNotOptimize(wire_json(tap.records()[0], tap.simulation().model()).dump());
  }
}
BENCHMARK(line_json);

void move_json(benchmark::State& state) {
  const CellEvent event{0, 1300, LineId{3}, EventBody{MoveTaken{'E', 5, 5}}};
  const ModelPtr model = test::rhino();
  for (auto _ : state) benchmark::DoNotOptimize(event_json(event, *model).dump());
}
BENCHMARK(move_json);

void camera_json(benchmark::State& state, monitor::Encoding encoding) {
  const Image image = camera_image(hundred(), initial_state(hundred()));
  for (auto _ : state) benchmark::DoNotOptimize(image_json(image, encoding).dump());
}
BENCHMARK_CAPTURE(camera_json, rows, monitor::Encoding::kRows)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(camera_json, rle, monitor::Encoding::kRle)->Unit(benchmark::kMicrosecond);

void camera_members(benchmark::State& state) {
  const Image image = camera_image(hundred(), initial_state(hundred()));
  for (auto _ : state) benchmark::DoNotOptimize(image_json(image, monitor::Encoding::kRows));
}
BENCHMARK(camera_members)->Unit(benchmark::kMicrosecond);

void camera_text(benchmark::State& state) {
  const Image image = camera_image(hundred(), initial_state(hundred()));
  for (auto _ : state) benchmark::DoNotOptimize(image_text(image, monitor::Encoding::kRows));
}
BENCHMARK(camera_text)->Unit(benchmark::kMicrosecond);

void display_members(benchmark::State& state) {
  const State home = initial_state(hundred());
  for (auto _ : state) benchmark::DoNotOptimize(display_json(hundred(), home));
}
BENCHMARK(display_members)->Unit(benchmark::kMicrosecond);

void wire_frame_json(benchmark::State& state) {
  const State home = initial_state(hundred());
  for (auto _ : state) benchmark::DoNotOptimize(display_json(hundred(), home).dump());
}
BENCHMARK(wire_frame_json)->Unit(benchmark::kMicrosecond);

void whole_model_json(benchmark::State& state) {
  const State home = initial_state(hundred());
  for (auto _ : state) benchmark::DoNotOptimize(model_json(hundred(), home, 1, "").dump());
}
BENCHMARK(whole_model_json)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace xr3
