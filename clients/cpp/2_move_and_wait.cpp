// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

/// Asks how far there is still to go until nothing is left. Between two questions it does nothing
/// for a while. A joint that is blocked would let us ask forever: we give up after kStandsMs
/// without a count.
void wait_for(Robot& robot, char joint) {
  int left = robot.to_go(joint);
  int still_ms = 0;  // for how long the counter has not changed
  while (left > 0) {
    std::cout << "  " << left << " counts to go\n";
    Robot::pause();
    const int before = left;
    left = robot.to_go(joint);
    still_ms = left == before ? still_ms + Robot::kPauseMs : 0;
    if (still_ms >= Robot::kStandsMs) {
      robot.send(std::string{joint, 'X'});  // forget the rest, or the next move would add to it
      Robot::check_arrived(joint, left);
    }
  }
  std::cout << joint << " is there\n";
}

int main(int argc, char* argv[]) try {
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
} catch (const std::exception& error) {
  // Whatever goes wrong above, robot.hpp says it in words, and we end up here.
  std::cerr << error.what() << "\n";
  return 1;
}
