// Fuzzes the loaders of robot, workcell and fault files: any text gives a value or findings; an
// accepted file gives a model that runs, and is equal after writing and reading.
//
// Input: the first byte selects the kind of file, the rest is its text.
#include <string_view>
#include <utility>

#include "core/simulation.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz::data_file_fuzzer {
namespace {

// A few moves of every motor, until limits, region or blocks stop them.
void exercise(Robot robot, Workcell workcell) {
  Simulation simulation(
      std::make_shared<const Model>(std::move(robot), std::move(workcell), Profile::kPaper));
  for (const int counts : {100, -128, 5}) {
    for (int i = 0; i < simulation.model().motor_count(); ++i) {
      simulation.execute(Move{simulation.model().motor(i).drive.label, counts});
    }
    simulation.advance_to(simulation.tick() + 300);
  }
}

void check(const Findings& findings) {
  for (const Finding& finding : findings)
    require(finding.more > 0 || !finding.allowed.empty(), "a finding says what is allowed");
}

void read_as_robot(std::string_view text) {
  FileReading<Robot> reading = read_robot(text, "robot.json");
  require(reading.value.has_value() != has_errors(reading.findings), "a robot, or why not");
  check(reading.findings);
  if (!reading.value) return;
  const FileReading<Robot> again = read_robot(robot_to_json(*reading.value).dump(), "robot.json");
  require(again.value == reading.value, "the robot written and read again");
  exercise(std::move(*reading.value), test::bare_workcell());
}

void read_as_workcell(std::string_view text) {
  FileReading<Workcell> reading = read_workcell(text, "workcell.json");
  require(reading.value.has_value() != has_errors(reading.findings), "a workcell, or why not");
  check(reading.findings);
  if (!reading.value) return;
  const std::string written = workcell_to_json(*reading.value).dump();
  require(read_workcell(written, "workcell.json").value == reading.value,
          "the workcell written and read again");
  exercise(test::robot_named("rhino-xr3"), std::move(*reading.value));
}

// A few moves, inquiries and images with these faults, and the lines' bytes through them.
void exercise(const FaultPlan& plan) {
  Simulation simulation(std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kMark3));
  simulation.install_faults(plan);
  for (const int counts : {100, -128, 5}) {
    for (char label = 'A'; label <= 'F'; ++label) simulation.execute(Move{label, counts});
    simulation.advance_to(simulation.tick() + 300);
    simulation.execute(QuerySwitchesI{});
    simulation.execute(CameraImage{});
    for (std::uint64_t i = 0; i < 9; ++i) simulation.carry_input({1, LineSide::kIn, i}, 'E');
    simulation.carry_reply({2, LineSide::kOut, 7}, "reply");
    simulation.stray_bytes({2, LineSide::kIn, 0});
  }
  simulation.run_to_rest(simulation.tick() + 10'000);
  simulation.clear_faults("");
}

void read_as_faults(std::string_view text) {
  FileReading<FaultPlan> reading = read_faults(text, "faults.json", "ABCDEF");
  require(reading.value.has_value() != has_errors(reading.findings), "faults, or why not");
  check(reading.findings);
  if (!reading.value) return;
  const std::string written = faults_to_json(*reading.value).dump();
  require(read_faults(written, "faults.json").value == reading.value,
          "the faults written and read again");
  exercise(*reading.value);
}

void run(std::string_view input, Effort /*all inputs are alike*/) {
  if (input.empty()) return;
  const std::string_view text = input.substr(1);
  if (input[0] == 'f') return read_as_faults(text);
  input[0] % 2 == 0 ? read_as_robot(text) : read_as_workcell(text);
}

const Registration kRegistration{{"data_file", 0, run}};

}  // namespace
}  // namespace xr3::fuzz::data_file_fuzzer
