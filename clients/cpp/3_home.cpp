// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     build/3_home [HOST [PORT]]

#include <iostream>

#include "robot.hpp"

struct Switch {
  char joint;
  int place;  // in counts from the soft home: upper arm upright, forearm level, tool down
};

// The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const Switch kSwitches[] = {{'D', 40}, {'E', -40}, {'C', 40}, {'B', -25}, {'F', 30}, {'A', 16}};

bool is_closed(Robot& robot, char joint) {
  return robot.ask(std::string{joint, 'V'}) == 1;  // a plain 0 or 1, nothing is added
}

void step(Robot& robot, char joint, int counts) {
  robot.send(move_of(joint, counts) + "\r");
  robot.wait(joint);  // asks as in example 2, and stops the joint if it cannot go on
}

int main(int argc, char* argv[]) {
  Robot robot(argc, argv);

  for (const auto& [joint, place] : kSwitches) {
    const int way = place > 0 ? 1 : -1;
    while (!is_closed(robot, joint)) step(robot, joint, 5 * way);  // quickly, until it closes
    while (is_closed(robot, joint)) step(robot, joint, -way);      // back, until it opens again
    while (!is_closed(robot, joint)) step(robot, joint, way);      // now we know to the count
    std::cout << joint << " stands on its switch, at " << std::showpos << place << "\n";
  }

  // All switches at once: I tells of joints C to F, J of A and B.
  const int i = robot.ask("I") - 32;
  const int j = robot.ask("J") - 32;
  std::cout << std::noshowpos << "switches closed: " << i << " of I, " << j << " of J\n";

  // From here the soft home is as far away as the switches are from it.
  for (const auto& [joint, place] : kSwitches) step(robot, joint, -place);
  std::cout << "at the soft home\n";
}
