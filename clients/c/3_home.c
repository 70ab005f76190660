/* 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
   switch that closes at one place of its way. Looking for that place is how a robot finds out.

       build/3_home [HOST [PORT]] */

#include <stdio.h>

#include "robot.h"

/* Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
   down. */
static const int SWITCHES[JOINTS] = {[F] = 30, [E] = -40, [D] = 40, [C] = 40, [B] = -25, [A] = 16};

/* The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last. */
static const int ORDER[JOINTS] = {D, E, C, B, F, A};

static int is_closed(int joint) {
  char inquiry[] = {LETTERS[joint], 'V', '\0'};
  return robot_ask(inquiry) == 1; /* this answer is a plain 0 or 1, nothing is added */
}

static void step(int joint, int counts) {
  robot_send("%c%+d\r", LETTERS[joint], counts);
  robot_wait(joint); /* asks as in example 2, and stops the joint if it cannot go on */
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  for (int i = 0; i < JOINTS; i++) {
    int joint = ORDER[i];
    int way = SWITCHES[joint] > 0 ? 1 : -1;
    while (!is_closed(joint)) step(joint, 5 * way); /* quickly, until the switch closes */
    while (is_closed(joint)) step(joint, -way);     /* back, until it opens again */
    while (!is_closed(joint)) step(joint, way);     /* slowly: now we know to the count */
    printf("%c stands on its switch, at %+d\n", LETTERS[joint], SWITCHES[joint]);
  }

  /* All switches at once: I tells of joints C to F, J of A and B. */
  int i = robot_ask("I") - 32;
  int j = robot_ask("J") - 32;
  printf("switches closed: %d of I, %d of J\n", i, j);

  /* From here the soft home is as far away as the switches are from it. */
  for (int k = 0; k < JOINTS; k++) step(ORDER[k], -SWITCHES[ORDER[k]]);
  printf("at the soft home\n");

  robot_close();
  return 0;
}
