// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     build/3_home [HOST [PORT]]

#include <exception>
#include <iostream>

#include "robot.hpp"

/// A switch closes at `place`, in counts from the soft home: upper arm upright, forearm level, tool
/// down. Seen from there it is open before this count, and closed from it on: for a few dozen
/// counts on a real arm, for longer in the simulator. One byte reports several switches: I those of
/// joints C to F, J those of A and B. Each has one `bit`.
struct Switch {
  char joint;
  int place;
  std::string inquiry;
  int bit;
};

// The shoulder, whose switch needs care, and the jaws.
const Switch kShoulder = {'E', -40, "I", 4};
const Switch kJaws = {'A', -16, "J", 16};

// The jaws come first: they show how a closed switch reads. The elbow, joint D, follows, since it
// lifts the hand off the table.
const Switch kSwitches[] = {
    kJaws, {'D', 40, "I", 2}, kShoulder, {'C', 40, "I", 1}, {'B', -25, "J", 32}, {'F', 30, "I", 8}};

const int kStep = 10;   // counts of one move of the search; a switch stays closed for longer
const int kFar = 1600;  // more counts than any joint has from a limit to its switch
const int kLean = 400;  // counts forward that bring the shoulder out of its backmost position

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

/// Moves until the switch closes, usually away from the soft home first. Returns false if it does
/// not close.
bool search(Robot& robot, const Switch& of, int away) {
  // Forwards first: a shoulder that leans back folds the arm into its base.
  if (of.joint == 'E') {
    return changes(robot, of, kStep, kLean) || changes(robot, of, -kStep, 2 * kFar);
  }
  if (changes(robot, of, kStep * away, kFar)) return true;
  // The shoulder may lean far back: it must not when the forearm comes down.
  if (of.joint == 'D') changes(robot, kShoulder, kStep, kLean);
  return changes(robot, of, -kStep * away, 2 * kFar);
}

/// Moves to the count at which the switch closes. `closed` is what a closed switch reads. Returns
/// false if the switch does not change.
bool find_near_edge(Robot& robot, const Switch& of, int closed) {
  const int away = of.place > 0 ? 1 : -1;
  if (read_switch(robot, of) != closed && !search(robot, of, away)) return false;
  // Back until the switch opens, and then count by count until it closes.
  return changes(robot, of, -kStep * away, kFar) && changes(robot, of, away, kFar);
}

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);

  // The open jaws are at the end of their travel, and on their switch. It opens when they close.
  changes(robot, kJaws, -kStep, kFar);
  const int closed = read_switch(robot, kJaws);  // the reading of a closed switch, 0 or 1

  // A shoulder on its switch may lean far back: it comes forward before the forearm moves.
  if (read_switch(robot, kShoulder) == closed) find_near_edge(robot, kShoulder, closed);

  for (const Switch& of : kSwitches) {
    if (!find_near_edge(robot, of, closed)) {
      throw std::runtime_error(
          std::string("the switch of ") + of.joint +
          " does not change. Is the joint blocked at a limit, or the arm stalled? Is the clock "
          "paused? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell)");
    }
    std::cout << of.joint << " is on its switch, at " << std::showpos << of.place << "\n";
  }

  // All switches at once. J also reports four input lines, in its bits 1 to 8.
  const int i = robot.ask("I") - 32;
  const int j = (robot.ask("J") - 32) & 48;
  std::cout << std::noshowpos << "a closed switch reads " << closed << "; the switches of I are "
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
