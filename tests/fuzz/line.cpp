// Fuzzes two serial lines of one robot with any bytes at any ticks. Invariants: joints are within
// their limits, blocked marks and phases follow from the counters, the machine comes to rest in
// time, and state and replies do not depend on the division of bytes and time.
//
// Input: the first byte selects the profile; then chunks as in common/chunks.hpp.
#include <algorithm>
#include <string>
#include <vector>

#include "core/motor.hpp"
#include "tests/fuzz/common/chunks.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/wire.hpp"

namespace xr3::fuzz::line_fuzzer {
namespace {

constexpr Tick kMaxTicks = 500'000;  // more only take time
constexpr Tick kMaxQuickTicks = 1000;
constexpr std::size_t kRestInterval = 64;

struct Cell {
  explicit Cell(ModelPtr model)
      : rig(std::move(model)),
        wires{Wire(rig.simulation.model_ptr()), Wire(rig.simulation.model_ptr())} {}

  using Wire = test::Wire;
  test::Rig rig;
  Wire wires[2];
  std::string replies[2];

  void send(int wire, std::string_view bytes) {
    wires[wire - 1].send(bytes, rig.simulation);
    replies[wire - 1] += wires[wire - 1].received();
  }
};

void check(const test::Rig& rig) {
  const Model& model = rig.model();
  const Positions at = positions(model, rig.state().motors);
  for (int i = 0; i < model.motor_count(); ++i) {
    const Counts position = at[static_cast<std::size_t>(i)];
    require(position >= model.motor(i).low && position <= model.motor(i).high, "limits");
    const MotorState& motor = rig.state().motor(i);
    require(motor.phase >= 0 && motor.phase < kPhasePerCount, "phase in range");
    require(motor.phase == 0 || is_running(motor), "phase of a motor at rest");
    require(motor.error != 0 || motor.blocked == Blocked::kNo, "blocked with nothing to do");
  }
}

/// At most 32 slices: more only take time.
void pass_in_slices(Tick ticks, test::Rig& rig) {
  const Tick slice = std::max<Tick>(7, ticks / 32 + 1);
  for (Tick left = ticks; left > 0; left -= std::min(left, slice)) rig.pass(std::min(left, slice));
}

void live(const std::vector<Chunk>& chunks, Cell& undivided, Cell& sliced) {
  for (const Chunk& chunk : chunks) {
    if (chunk.wire != 0) {
      undivided.send(chunk.wire, chunk.bytes);
      for (const char& byte : chunk.bytes) sliced.send(chunk.wire, {&byte, 1});
    } else {
      undivided.rig.pass(chunk.ticks);
      pass_in_slices(chunk.ticks, sliced.rig);
    }
    check(undivided.rig);
  }
}

void check_rest(test::Rig& rig) {
  const Tick longest = 128'000 + Tick{1000} * rig.model().motor_count();
  rig.simulation.run_to_rest(rig.simulation.tick() + longest);
  require(rig.simulation.is_at_rest(), "rest without input");
}

ModelPtr model_for(Profile profile) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                       test::workcell_named("rhino-xr3"), profile);
}

void run(std::string_view input, Effort effort) {
  static const ModelPtr models[] = {model_for(Profile::kPaper), model_for(Profile::kMark3)};
  if (input.empty()) return;
  const bool is_full = effort == Effort::kFull;
  const ModelPtr& model = models[input[0] & 1];
  Cell undivided(model);
  Cell sliced(model);
  live(chunks_of(input.substr(1), is_full ? kMaxTicks : kMaxQuickTicks), undivided, sliced);
  require(undivided.rig.state() == sliced.rig.state(), "state of sliced time and bytes");
  require(undivided.replies[0] == sliced.replies[0], "replies on line 1");
  require(undivided.replies[1] == sliced.replies[1], "replies on line 2");
  if (is_full || input.size() % kRestInterval == 0) check_rest(undivided.rig);
}

const Registration kRegistration{{"line", 256, run}};

}  // namespace
}  // namespace xr3::fuzz::line_fuzzer
