// Fuzzes the loaders of robot and workcell files: any text gives a value or findings; an accepted
// file gives a model that runs, and is equal after writing and reading.
//
// Input: the first byte selects the kind of file, the rest is its text.
#include <string_view>
#include <utility>

#include "core/simulation.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz {
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

void read_as_robot(std::string_view text) {
  RobotReading reading = read_robot(text, "robot.json");
  require(reading.robot.has_value() != has_errors(reading.findings), "a robot, or why not");
  if (!reading.robot) return;
  const RobotReading again = read_robot(robot_to_json(*reading.robot).dump(), "robot.json");
  require(again.robot == reading.robot, "the robot written and read again");
  exercise(std::move(*reading.robot), test::bare_workcell());
}

void read_as_workcell(std::string_view text) {
  WorkcellReading reading = read_workcell(text, "workcell.json");
  require(reading.workcell.has_value() != has_errors(reading.findings), "a workcell, or why not");
  if (!reading.workcell) return;
  const std::string written = workcell_to_json(*reading.workcell).dump();
  require(read_workcell(written, "workcell.json").workcell == reading.workcell,
          "the workcell written and read again");
  exercise(test::robot_named("rhino-xr3"), std::move(*reading.workcell));
}

}  // namespace

const std::size_t kMaxInput = 0;

void run(std::string_view input, Effort /*all inputs are alike*/) {
  if (input.empty()) return;
  const std::string_view text = input.substr(1);
  input[0] % 2 == 0 ? read_as_robot(text) : read_as_workcell(text);
}

}  // namespace xr3::fuzz
