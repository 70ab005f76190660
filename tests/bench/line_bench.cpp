// Throughput of a line in bytes per second: the parser alone, and with HTTP and TLS detector,
// telnet filter, endpoint and machine.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "protocol/line/rhino_parser.hpp"
#include "tests/support/models.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/support/wire.hpp"

namespace xr3 {
namespace {

const std::string& polling() {
  static const std::string bytes = [] {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "E+5\r\nE?D-5\r\nD?C+3\rC?I";
    return text;
  }();
  return bytes;
}

const std::string& anything() {
  static const std::string bytes = test::RandomBytes(1).stream(5000);
  return bytes;
}

void parse(benchmark::State& state, const std::string& bytes) {
  RhinoParser parser(Profile::kPaper);
  std::vector<Parsed> parsed;
  for (auto _ : state) {
    std::uint64_t offset = 0;
    for (const char byte : bytes) {
      parsed.clear();
      parser.feed(static_cast<std::uint8_t>(byte), offset++, parsed);
      benchmark::DoNotOptimize(parsed.data());
    }
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK_CAPTURE(parse, polling, polling());
BENCHMARK_CAPTURE(parse, anything, anything());

void whole_line(benchmark::State& state, const std::string& bytes) {
  Simulation simulation(test::rhino());
  for (auto _ : state) {
    test::Wire wire(simulation.model_ptr());
    wire.send(bytes, simulation);
    benchmark::DoNotOptimize(wire.received());
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK_CAPTURE(whole_line, polling, polling());
BENCHMARK_CAPTURE(whole_line, anything, anything());

}  // namespace
}  // namespace xr3
