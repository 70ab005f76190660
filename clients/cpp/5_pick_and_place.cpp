// 5. Pick and place at known positions: take the red block from where it lies, and put it somewhere
// else.
//
//     build/5_pick_and_place [HOST [PORT]]
//
// The arm has to be at its soft home, as it is when the simulator starts, or after 3_home.

#include <exception>
#include <iomanip>
#include <iostream>

#include "robot.hpp"

// Where the motors have to be, in counts from the soft home, for the tool to be at a place. `xr3
// kin --pose 262,0,20 --down 90` works out the one of the block: its middle is at x 262, y 0 and
// z 20 mm, and it is turned by 90 degrees. "Above" is 100 mm higher up. On a real arm one would
// drive there by hand and write the counts down.
const Counts kAboveBlock{{'F', 0}, {'E', 242}, {'D', -440}, {'C', 0}, {'B', 0}};
const Counts kAtBlock{{'F', 0}, {'E', 449}, {'D', -625}, {'C', 0}, {'B', 0}};
const Counts kAbovePlace{{'F', 0}, {'E', 483}, {'D', -238}, {'C', 0}, {'B', 288}};  // x 400, y 0
const Counts kAtPlace{{'F', 0}, {'E', 623}, {'D', -354}, {'C', 0}, {'B', 288}};
const int kShut = -64;  // where the jaws, joint A, meet
const Counts kHome{{'F', 0}, {'E', 0}, {'D', 0}, {'C', 0}, {'B', 0}, {'A', 0}};

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);
  std::cout << std::fixed << std::setprecision(1);

  // robot.go() brings all joints to these counts together. A single move is at most 127 counts
  // long, so go() sends several, and waits after each.
  robot.go({{'A', 16}});
  std::cout << "the jaws are open\n";
  robot.go(kAboveBlock);
  std::cout << "above the block\n";
  robot.go(kAtBlock);

  // Close the jaws much further than the block lets them. They stop at the block, and what is
  // left to go tells how wide it is: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
  // wait() also clears what is left (AX), or the jaws would go on pressing.
  robot.send("A-100\r");
  robot.at['A'] -= 100 - robot.wait('A');
  if (robot.at['A'] <= kShut) {
    std::cerr << "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to "
                 "have it there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell, "
                 "in the profile paper)\n";
    robot.go(kAboveBlock);  // back to where the examples begin
    robot.go(kHome);
    return 1;
  }
  std::cout << "the jaws closed on " << 50.8 + 0.79375 * robot.at['A'] << " mm\n";

  robot.go(kAboveBlock);
  std::cout << "lifted\n";
  robot.go(kAbovePlace);
  robot.go(kAtPlace);
  std::cout << "at its new place\n";
  robot.go({{'A', 16}});
  std::cout << "let go\n";
  robot.go(kAbovePlace);
  robot.go(kHome);
  std::cout << "back at the start\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
