// 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
//
//     build/5_pick_and_place [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.

#include <exception>
#include <iomanip>
#include <iostream>

#include "robot.hpp"

// Motor counts from the soft home for each position of the tool.
// `xr3 kin --pose 262,0,20 --down 90` computes those at the block, whose centre is at x 262, y 0
// and z 20 mm, with a yaw of 90 degrees. "Above" is 100 mm higher. On a real arm one would move
// there manually and note the counts.
const Counts kAboveBlock{{'F', 0}, {'E', 242}, {'D', -440}, {'C', 0}, {'B', 0}};
const Counts kAtBlock{{'F', 0}, {'E', 449}, {'D', -625}, {'C', 0}, {'B', 0}};
const Counts kAbovePlace{{'F', 0}, {'E', 483}, {'D', -238}, {'C', 0}, {'B', 288}};  // x 400, y 0
const Counts kAtPlace{{'F', 0}, {'E', 623}, {'D', -354}, {'C', 0}, {'B', 288}};
const int kShut = 64;  // count of A at which the jaws are closed
const Counts kHome{{'F', 0}, {'E', 0}, {'D', 0}, {'C', 0}, {'B', 0}, {'A', 0}};

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);
  std::cout << std::fixed << std::setprecision(1);

  // robot.go() moves all joints to these counts together. A single move is limited to 127 counts,
  // so go() sends several and waits after each.
  robot.go({{'A', -16}});
  std::cout << "the jaws are open\n";
  robot.go(kAboveBlock);
  std::cout << "above the block\n";
  robot.go(kAtBlock);

  // Command the jaws to close much further than the block permits. They stop at the block, and the
  // remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
  // wait() also cancels the remaining counts (AX); otherwise the jaws would keep pressing.
  robot.send("A+90\r");
  robot.at['A'] += 90 - robot.wait('A');
  if (robot.at['A'] >= kShut) {
    std::cerr << "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to "
                 "have it there (the examples 3 to 6 are for the Rhino XR-3 with its own "
                 "workcell)\n";
    robot.go(kAboveBlock);  // back to the start position
    robot.go(kHome);
    return 1;
  }
  std::cout << "the jaws closed on " << 50.8 - 0.79375 * robot.at['A'] << " mm\n";

  robot.go(kAboveBlock);
  std::cout << "lifted\n";
  robot.go(kAbovePlace);
  robot.go(kAtPlace);
  std::cout << "at its new place\n";
  robot.go({{'A', -16}});
  std::cout << "let go\n";
  robot.go(kAbovePlace);
  robot.go(kHome);
  std::cout << "back at the start\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
