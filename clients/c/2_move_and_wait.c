/* 2. Move and wait: send a joint somewhere, and ask until it has arrived.

       build/2_move_and_wait [HOST [PORT]] */

#include <stdio.h>

#include "robot.h"

/* Asks how far there is still to go until nothing is left. Between two questions it does nothing
   for a while. A joint that is blocked would let us ask forever: we give up after STANDS_MS without
   a count. */
static void wait_for(int joint) {
  int left = robot_to_go(joint);
  int still_ms = 0; /* for how long the counter has not changed */
  while (left > 0) {
    printf("  %d counts to go\n", left);
    wait_ms(PAUSE_MS);
    int before = left;
    left = robot_to_go(joint);
    still_ms = left == before ? still_ms + PAUSE_MS : 0;
    if (still_ms >= STANDS_MS) {
      robot_send("%cX", LETTERS[joint]); /* forget the rest, or the next move would add to it */
      robot_stands(joint, left);
    }
  }
  printf("%c is there\n", LETTERS[joint]);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that
     the number ends here. It starts to move, and answers nothing: so we ask. */
  printf("E+50\n");
  robot_send("E+50\r");
  wait_for(E);

  /* And back again. */
  printf("E-50\n");
  robot_send("E-50\r");
  wait_for(E);

  robot_close();
  return 0;
}
