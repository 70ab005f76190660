// 4. Two joints at once: base and shoulder start together, and the program waits for both.
//
//     build/4_two_joints [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  // Each joint has its own motor, and the robot does not wait: both start now.
  // The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
  robot.send("F+40 E+80\r");
  std::cout << "F+40 E+80\n";

  int f = robot.to_go('F');
  int e = robot.to_go('E');
  int same = 0;  // number of equal answers in a row, as in example 2
  while (f > 0 || e > 0) {
    std::cout << "  F " << f << ", E " << e << " counts to go\n";
    Robot::pause();
    const int before = f + e;
    f = robot.to_go('F');
    e = robot.to_go('E');
    same = f + e == before ? same + 1 : 0;
    if (same == Robot::kStandsAfter) {
      robot.send("FX EX");  // cancel the rest: the next move would add to it
      Robot::check_arrived('F', f);
      Robot::check_arrived('E', e);
    }
  }
  std::cout << "both are there\n";

  // Move back. wait() is the loop of example 2, for one joint after the other.
  robot.send("F-40 E-80\r");
  Robot::check_arrived('F', robot.wait('F'));
  Robot::check_arrived('E', robot.wait('E'));
  std::cout << "both are back\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
