/* 2. Move and wait: move a joint and ask until it has arrived.

       build/2_move_and_wait [HOST [PORT]] */

#include <stdio.h>

#include "robot.h"

/* Asks for the remaining counts until none are left, with a pause between two questions. A blocked
   joint would never finish, so the program gives up after STANDS_AFTER equal answers. */
static void wait_for(int joint) {
  int left = robot_to_go(joint);
  int same = 0; /* number of equal answers in a row */
  while (left > 0) {
    printf("  %d counts to go\n", left);
    robot_pause();
    int before = left;
    left = robot_to_go(joint);
    same = left == before ? same + 1 : 0;
    if (same == STANDS_AFTER) {
      robot_send("%cX", LETTERS[joint]); /* cancel the rest: the next move would add to it */
      robot_stands(joint, left);
    }
  }
  printf("%c is there\n", LETTERS[joint]);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
     starts to move and does not answer, so the program has to ask. */
  printf("E+50\n");
  robot_send("E+50\r");
  wait_for(E);

  /* Move back. */
  printf("E-50\n");
  robot_send("E-50\r");
  wait_for(E);

  robot_close();
  return 0;
}
