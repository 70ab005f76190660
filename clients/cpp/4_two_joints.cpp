// 4. Two joints at once, with speeds: base and shoulder start together and arrive together.
//
//     build/4_two_joints [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  // A number with an S behind it is a speed, in counts a second. E has twice as far to go as F,
  // so it gets twice the speed.
  robot.send("F40S E80S\r");
  std::cout << "F runs at 40 counts a second, E at 80\n";

  // Each joint has a motor of its own, and the robot does not wait: both run from here on.
  robot.send("F+40 E+80\r");
  std::cout << "F+40 E+80\n";

  int f = robot.to_go('F');
  int e = robot.to_go('E');
  int still_ms = 0;  // for how long neither counter has changed, as in example 2
  while (f > 0 || e > 0) {
    std::cout << "  F " << f << ", E " << e << " counts to go\n";
    Robot::pause();
    const int before = f + e;
    f = robot.to_go('F');
    e = robot.to_go('E');
    still_ms = f + e == before ? still_ms + Robot::kPauseMs : 0;
    if (still_ms >= Robot::kStandsMs) {
      robot.send("FX EX");  // forget the rest, or the next move would add to it
      Robot::check_arrived('F', f);
      Robot::check_arrived('E', e);
    }
  }
  std::cout << "both are there\n";

  // And back again. wait() is example 2 once more, for one joint after the other.
  robot.send("F-40 E-80\r");
  Robot::check_arrived('F', robot.wait('F'));
  Robot::check_arrived('E', robot.wait('E'));
  std::cout << "both are back\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
