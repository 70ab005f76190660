/* Exercise 7: pick up green and yellow at known places, and put them down elsewhere. */

#include "robot.h"

enum { kOpen = -16, kClosing = 90, kShut = 64 }; /* counts of A */

/* Motor counts of F, E, D, C and B from the soft home, by `xr3 kin --pose X,Y,Z --down YAW`. */
typedef int Counts[5];
static const Counts above_green = {71, 381, -343, 0, 260};
static const Counts at_green = {71, 543, -479, 0, 260};
static const Counts above_green_goal = {0, 489, -245, 0, 0};
static const Counts at_green_goal = {0, 632, -358, 0, 0};
static const Counts above_yellow = {144, 242, -468, 0, 201};
static const Counts at_yellow = {144, 460, -655, 0, 201};
static const Counts above_yellow_goal = {-38, 485, -256, 0, -28};
static const Counts at_yellow_goal = {-38, 630, -369, 0, -28};
static const Counts home = {0};

static void go(const Counts counts) { robot_go("FEDCB", counts); }

static void move_jaws(int count) { robot_go("A", &count); }

/* Closes the jaws until they stand; robot_wait clears the rest with AX. */
static void close_jaws(void) {
  robot_send("A+%d\r", kClosing);
  robot_at[0] += kClosing - robot_wait('A');
  if (robot_at[0] >= kShut) robot_give_up("the jaws closed on nothing");
  printf("the jaws hold %.1f mm\n", 50.8 - 0.79375 * robot_at[0]);
}

static void carry(const Counts above, const Counts at, const Counts above_goal,
                  const Counts at_goal) {
  move_jaws(kOpen);
  go(above);
  go(at);
  close_jaws();
  go(above);
  go(above_goal);
  go(at_goal);
  move_jaws(kOpen);
  go(above_goal);
}

int main(void) {
  robot_connect();
  carry(above_green, at_green, above_green_goal, at_green_goal);
  carry(above_yellow, at_yellow, above_yellow_goal, at_yellow_goal);
  go(home);
  move_jaws(0);
  robot_close();
  return 0;
}
