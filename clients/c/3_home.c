/* 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
   switch that closes at one place of its way. Looking for that place is how a robot finds out.

       build/3_home [HOST [PORT]] */

#include <stdio.h>
#include <stdlib.h>

#include "robot.h"

/* Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
   down. */
static const int SWITCHES[JOINTS] = {[F] = 30, [E] = -40, [D] = 40, [C] = 40, [B] = -25, [A] = 16};

/* The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last. */
static const int ORDER[JOINTS] = {D, E, C, B, F, A};

/* No joint has so many counts to go from one end of its way to the other. */
enum { FARTHEST = 2500 };

static int is_closed(int joint) {
  char inquiry[] = {LETTERS[joint], 'V', '\0'};
  return robot_ask(inquiry) == 1; /* this answer is a plain 0 or 1, nothing is added */
}

/* Moves the joint and returns how many counts were left, if it could not go on. */
static int step(int joint, int counts) {
  robot_send("%c%+d\r", LETTERS[joint], counts);
  return robot_wait(joint); /* asks as in example 2, and stops a joint that stands */
}

/* Steps of so many counts until the switch is as wanted: 1 closed, 0 open. */
static void search(int joint, int counts, int wanted) {
  for (int gone = 0; is_closed(joint) != wanted; gone += abs(counts)) {
    int left = step(joint, counts);
    if (left == abs(counts)) {
      robot_give_up("%c does not move, and its switch is not found. Is it at a limit, or stalled? "
                    "Does time stand? This example is for the Rhino XR-3, in the profile paper",
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

  /* A robot may tell of its switches the other way round. I shows it: the highest of its six bits
     belongs to no switch, and should be 0. */
  if (robot_ask("I") - 32 >= 32) {
    robot_give_up("the switches of D and of all other joints tell 1 when they are open, as in the "
                  "profile mark3. This example is for the profile paper");
  }

  for (int i = 0; i < JOINTS; i++) {
    int joint = ORDER[i];
    int way = SWITCHES[joint] > 0 ? 1 : -1;
    search(joint, 5 * way, 1);  /* quickly, until the switch closes */
    search(joint, -5 * way, 0); /* back, until it opens again */
    search(joint, way, 1);      /* slowly: now we know to the count where it closes */
    printf("%c stands on its switch, at %+d\n", LETTERS[joint], SWITCHES[joint]);
  }

  /* All switches at once: I tells of joints C to F, J of A and B. */
  int i = robot_ask("I") - 32;
  int j = robot_ask("J") - 32;
  printf("switches closed: %d of I, %d of J\n", i, j);

  /* From here the soft home is as far away as the switches are from it. */
  for (int k = 0; k < JOINTS; k++) {
    int left = step(ORDER[k], -SWITCHES[ORDER[k]]);
    if (left > 0) robot_stands(ORDER[k], left);
  }
  printf("at the soft home\n");

  robot_close();
  return 0;
}
