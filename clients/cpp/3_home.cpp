// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     build/3_home [HOST [PORT]]

#include <exception>
#include <iostream>
#include <optional>

#include "robot.hpp"

// More counts than any joint has from a limit to its switch.
const int kFar = 1600;

/// A switch closes at `place`, in counts from the soft home: upper arm upright, forearm level, tool
/// down. Seen from there it is open before this count, and closed from it on: for a few dozen
/// counts on a real arm, for longer in the simulator. One byte reports several switches: I those of
/// joints C to F, J those of A and B. Each has one `bit`. `reach` is how far to search away from the
/// soft home before trying the other direction.
struct Switch {
  char joint;
  int place;
  std::string inquiry;
  int bit;
  int reach = kFar;
};

// The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last. The
// shoulder must not lean far back, or the hand hits the base.
const Switch kSwitches[] = {{'D', 40, "I", 2},  {'E', -40, "I", 4, 60}, {'C', 40, "I", 1},
                            {'B', -25, "J", 2}, {'F', 30, "I", 8},      {'A', 16, "J", 1}};

const int kStep = 10;     // counts of one move of the search; a switch stays closed for longer
const int kWidest = 100;  // more counts than a switch of a real arm stays closed

/// The bit of the joint's switch. Some controllers report a closed switch as 1, others as 0.
int read_switch(Robot& robot, const Switch& of) {
  return (robot.ask(of.inquiry) - 32) & of.bit ? 1 : 0;
}

/// Moves the joint and returns the counts that were left, 0 if it has arrived.
int step(Robot& robot, char joint, int counts) {
  robot.send(move_of(joint, counts) + "\r");
  return robot.wait(joint);  // as in example 2; cancels the move of a blocked joint
}

/// Moves in steps of `counts` until the switch changes. Returns false if it does not within
/// `farthest` counts, or before the joint is blocked.
bool changes(Robot& robot, const Switch& of, int counts, int farthest) {
  const int before = read_switch(robot, of);
  for (int gone = 0; gone < farthest; gone += std::abs(counts)) {
    const int left = step(robot, of.joint, counts);
    if (read_switch(robot, of) != before) return true;
    if (left > 0) return false;
  }
  return false;
}

/// Moves to the count at which the switch closes. `closed` is what a closed switch reads, if it is
/// known. Returns false if the switch does not change.
bool find_near_edge(Robot& robot, const Switch& of, std::optional<int> closed) {
  const int away = of.place > 0 ? 1 : -1;

  // Watch the switch change, at whichever edge: first in one direction, then in the other. If it
  // reads like the closed ones before, the near edge lies towards the soft home.
  const bool is_closed = read_switch(robot, of) == closed;
  const int way = is_closed ? -away : away;
  const int reach = is_closed ? kFar : of.reach;
  if (!changes(robot, of, kStep * way, reach) && !changes(robot, of, -kStep * way, 2 * kFar) &&
      !changes(robot, of, kStep * way, 2 * kFar)) {
    return false;
  }

  // Move towards the soft home until the switch has not changed for a long way: now it is open.
  while (changes(robot, of, -kStep * away, kWidest)) {
  }

  // Quickly up to the near edge, back again, and then count by count.
  return changes(robot, of, kStep * away, kFar) && changes(robot, of, -kStep * away, kFar) &&
         changes(robot, of, away, kFar);
}

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  std::optional<int> closed;  // what a closed switch reads: unknown until the first has changed
  for (const Switch& of : kSwitches) {
    if (!find_near_edge(robot, of, closed)) {
      throw std::runtime_error(
          std::string("the switch of ") + of.joint +
          " does not change. Is the joint blocked at a limit, or the arm stalled? Is the clock "
          "paused? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell)");
    }
    closed = read_switch(robot, of);
    std::cout << of.joint << " is on its switch, at " << std::showpos << of.place << "\n";
  }

  // All switches at once. J also reports four input lines, in its bits 4 to 32.
  const int i = robot.ask("I") - 32;
  const int j = (robot.ask("J") - 32) & 3;
  std::cout << std::noshowpos << "a closed switch reads " << *closed << "; the switches of I are "
            << i << ", those of J " << j << "\n";

  // The soft home is at count 0: move each joint back by the count of its switch.
  for (const Switch& of : kSwitches) {
    Robot::check_arrived(of.joint, step(robot, of.joint, -of.place));
  }
  std::cout << "at the soft home\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
