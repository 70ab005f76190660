// 2. Move and wait: move a joint and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

/// Asks for the remaining counts until none are left, with a pause between two questions. A blocked
/// joint would never finish, so the program gives up after kStandsAfter equal answers.
void wait_for(Robot& robot, char joint) {
  int left = robot.to_go(joint);
  int same = 0;  // number of equal answers in a row
  while (left > 0) {
    std::cout << "  " << left << " counts to go\n";
    Robot::pause();
    const int before = left;
    left = robot.to_go(joint);
    same = left == before ? same + 1 : 0;
    if (same == Robot::kStandsAfter) {
      robot.send(std::string{joint, 'X'});  // cancel the rest: the next move would add to it
      Robot::check_arrived(joint, left);
    }
  }
  std::cout << joint << " is there\n";
}

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  // Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
  // starts to move and does not answer, so the program has to ask.
  std::cout << "E+50\n";
  robot.send("E+50\r");
  wait_for(robot, 'E');

  // Move back.
  std::cout << "E-50\n";
  robot.send("E-50\r");
  wait_for(robot, 'E');
} catch (const std::exception& error) {
  // robot.hpp reports all failures by exceptions with a readable message.
  std::cerr << error.what() << "\n";
  return 1;
}
