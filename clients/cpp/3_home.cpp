// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     build/3_home [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

struct Switch {
  char joint;
  int place;  // in counts from the soft home: upper arm upright, forearm level, tool down
};

// The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const Switch kSwitches[] = {{'D', 40}, {'E', -40}, {'C', 40}, {'B', -25}, {'F', 30}, {'A', 16}};

// No joint has so many counts to go from one end of its way to the other.
const int kFarthest = 2500;

bool is_closed(Robot& robot, char joint) {
  return robot.ask(std::string{joint, 'V'}) == 1;  // a plain 0 or 1, nothing is added
}

/// Moves the joint and returns how many counts were left, if it could not go on.
int step(Robot& robot, char joint, int counts) {
  robot.send(move_of(joint, counts) + "\r");
  return robot.wait(joint);  // asks as in example 2, and stops a joint that stands
}

/// Steps of so many counts until the switch is closed, or until it is open.
void search(Robot& robot, char joint, int counts, bool closed) {
  for (int gone = 0; is_closed(robot, joint) != closed; gone += std::abs(counts)) {
    if (step(robot, joint, counts) == std::abs(counts)) {
      throw std::runtime_error(
          std::string{joint} +
          " does not move, and its switch is not found. Is it at a limit, or stalled? Does time "
          "stand? This example is for the Rhino XR-3, in the profile paper");
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

  // A robot may tell of its switches the other way round. I shows it: the highest of its six bits
  // belongs to no switch, and should be 0.
  if (robot.ask("I") - 32 >= 32) {
    throw std::runtime_error(
        "the switches of D and of all other joints tell 1 when they are open, as in the profile "
        "mark3. This example is for the profile paper");
  }

  for (const auto& [joint, place] : kSwitches) {
    const int way = place > 0 ? 1 : -1;
    search(robot, joint, 5 * way, true);    // quickly, until the switch closes
    search(robot, joint, -5 * way, false);  // back, until it opens again
    search(robot, joint, way, true);        // slowly: now we know to the count where it closes
    std::cout << joint << " stands on its switch, at " << std::showpos << place << "\n";
  }

  // All switches at once: I tells of joints C to F, J of A and B.
  const int i = robot.ask("I") - 32;
  const int j = robot.ask("J") - 32;
  std::cout << std::noshowpos << "switches closed: " << i << " of I, " << j << " of J\n";

  // From here the soft home is as far away as the switches are from it.
  for (const auto& [joint, place] : kSwitches) {
    Robot::check_arrived(joint, step(robot, joint, -place));
  }
  std::cout << "at the soft home\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
