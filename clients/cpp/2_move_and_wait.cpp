// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

#include <iostream>

#include "robot.hpp"

/// Asks how far there is still to go until nothing is left. Between two questions it does nothing
/// for a while.
void wait_for(Robot& robot, char joint) {
  int left = robot.to_go(joint);
  while (left > 0) {
    std::cout << "  " << left << " counts to go\n";
    Robot::pause();
    left = robot.to_go(joint);
  }
  std::cout << joint << " is there\n";
}

int main(int argc, char* argv[]) {
  Robot robot(argc, argv);

  // The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that
  // the number ends here. It starts to move, and answers nothing: so we ask.
  std::cout << "E+50\n";
  robot.send("E+50\r");
  wait_for(robot, 'E');

  // And back again.
  std::cout << "E-50\n";
  robot.send("E-50\r");
  wait_for(robot, 'E');
}
