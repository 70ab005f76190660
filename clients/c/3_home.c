/* 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
   switch that closes at a known position. Searching for it tells where the joint is.

       build/3_home [HOST [PORT]] */

#include <stdio.h>
#include <stdlib.h>

#include "robot.h"

/* Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
   down. */
static const int SWITCHES[JOINTS] = {[F] = 30, [E] = -40, [D] = 40, [C] = 40, [B] = -25, [A] = 16};

/* The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last. */
static const int ORDER[JOINTS] = {D, E, C, B, F, A};

/* More counts than the full travel of any joint. */
enum { FARTHEST = 2500 };

static int is_closed(int joint) {
  char inquiry[] = {LETTERS[joint], 'V', '\0'};
  return robot_ask(inquiry) == 1; /* this answer is 0 or 1, without the 32 */
}

/* Moves the joint and returns the counts that were left, 0 if it has arrived. */
static int step(int joint, int counts) {
  robot_send("%c%+d\r", LETTERS[joint], counts);
  return robot_wait(joint); /* as in example 2; cancels the move of a blocked joint */
}

/* Moves in steps of `counts` until the switch is closed (1) or open (0). */
static void search(int joint, int counts, int wanted) {
  for (int gone = 0; is_closed(joint) != wanted; gone += abs(counts)) {
    int left = step(joint, counts);
    if (left == abs(counts)) {
      robot_give_up("%c does not move, and its switch is not found. Is it at a limit, or stalled? "
                    "Is the clock paused? This example is for the Rhino XR-3, in the profile paper",
                    LETTERS[joint]);
    }
    if (gone > FARTHEST) {
      robot_give_up("%c went %d counts, and its switch is not found. This example is for the "
                    "Rhino XR-3, in the profile paper", LETTERS[joint], gone);
    }
  }
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* Some controllers report their switches inverted. The answer to I shows it: the highest of its
     six bits belongs to no switch and should be 0. */
  if (robot_ask("I") - 32 >= 32) {
    robot_give_up("the switches of D and of all other joints read 1 when they are open, as in the "
                  "profile mark3. This example is for the profile paper");
  }

  for (int i = 0; i < JOINTS; i++) {
    int joint = ORDER[i];
    int way = SWITCHES[joint] > 0 ? 1 : -1;
    search(joint, 5 * way, 1);  /* quickly, until the switch closes */
    search(joint, -5 * way, 0); /* back, until it opens again */
    search(joint, way, 1);      /* slowly, to find the exact count at which it closes */
    printf("%c is on its switch, at %+d\n", LETTERS[joint], SWITCHES[joint]);
  }

  /* All switches at once: I reports joints C to F, J reports A and B. */
  int i = robot_ask("I") - 32;
  int j = robot_ask("J") - 32;
  printf("switches closed: %d of I, %d of J\n", i, j);

  /* The soft home is at count 0: move each joint back by the count of its switch. */
  for (int k = 0; k < JOINTS; k++) {
    int left = step(ORDER[k], -SWITCHES[ORDER[k]]);
    if (left > 0) robot_stands(ORDER[k], left);
  }
  printf("at the soft home\n");

  robot_close();
  return 0;
}
