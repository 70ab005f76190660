// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     build/3_home [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

struct Switch {
  char joint;
  int place;  // in counts from the soft home: upper arm upright, forearm level, tool down
};

// The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
const Switch kSwitches[] = {{'D', 40}, {'E', -40}, {'C', 40}, {'B', -25}, {'F', 30}, {'A', 16}};

// More counts than the full travel of any joint.
const int kFarthest = 2500;

bool is_closed(Robot& robot, char joint) {
  return robot.ask(std::string{joint, 'V'}) == 1;  // 0 or 1, without the 32
}

/// Moves the joint and returns the counts that were left, 0 if it has arrived.
int step(Robot& robot, char joint, int counts) {
  robot.send(move_of(joint, counts) + "\r");
  return robot.wait(joint);  // as in example 2; cancels the move of a blocked joint
}

/// Moves in steps of `counts` until the switch is closed (true) or open (false).
void search(Robot& robot, char joint, int counts, bool closed) {
  for (int gone = 0; is_closed(robot, joint) != closed; gone += std::abs(counts)) {
    if (step(robot, joint, counts) == std::abs(counts)) {
      throw std::runtime_error(
          std::string{joint} +
          " does not move, and its switch is not found. Is it at a limit, or stalled? Is the "
          "clock paused? This example is for the Rhino XR-3, in the profile paper");
    }
    if (gone > kFarthest) {
      throw std::runtime_error(
          std::string{joint} + " went " + std::to_string(gone) +
          " counts, and its switch is not found. This example is for the Rhino XR-3, in the "
          "profile paper");
    }
  }
}

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  // Some controllers report their switches inverted. The answer to I shows it: the highest of its
  // six bits belongs to no switch and should be 0.
  if (robot.ask("I") - 32 >= 32) {
    throw std::runtime_error(
        "the switches of D and of all other joints read 1 when they are open, as in the profile "
        "mark3. This example is for the profile paper");
  }

  for (const auto& [joint, place] : kSwitches) {
    const int way = place > 0 ? 1 : -1;
    search(robot, joint, 5 * way, true);    // quickly, until the switch closes
    search(robot, joint, -5 * way, false);  // back, until it opens again
    search(robot, joint, way, true);        // slowly, to find the exact count at which it closes
    std::cout << joint << " is on its switch, at " << std::showpos << place << "\n";
  }

  // All switches at once: I reports joints C to F, J reports A and B.
  const int i = robot.ask("I") - 32;
  const int j = robot.ask("J") - 32;
  std::cout << std::noshowpos << "switches closed: " << i << " of I, " << j << " of J\n";

  // The soft home is at count 0: move each joint back by the count of its switch.
  for (const auto& [joint, place] : kSwitches) {
    Robot::check_arrived(joint, step(robot, joint, -place));
  }
  std::cout << "at the soft home\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
