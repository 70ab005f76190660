/* 4. Two joints at once, with speeds: base and shoulder start together and arrive together.

       build/4_two_joints [HOST [PORT]] */

#include <stdio.h>

#include "robot.h"

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* A number with an S behind it is a speed, in counts a second. E has twice as far to go as F,
     so it gets twice the speed. */
  robot_send("F40S E80S\r");
  printf("F runs at 40 counts a second, E at 80\n");

  /* Each joint has a motor of its own, and the robot does not wait: both run from here on. */
  robot_send("F+40 E+80\r");
  printf("F+40 E+80\n");

  int f = robot_to_go(F), e = robot_to_go(E);
  int still_ms = 0; /* for how long neither counter has changed, as in example 2 */
  while (f > 0 || e > 0) {
    printf("  F %d, E %d counts to go\n", f, e);
    wait_ms(PAUSE_MS);
    int before = f + e;
    f = robot_to_go(F);
    e = robot_to_go(E);
    still_ms = f + e == before ? still_ms + PAUSE_MS : 0;
    if (still_ms >= STANDS_MS) {
      robot_send("FX EX"); /* forget the rest, or the next move would add to it */
      if (f > 0) robot_stands(F, f);
      if (e > 0) robot_stands(E, e);
    }
  }
  printf("both are there\n");

  /* And back again. robot_wait is example 2 once more, for one joint after the other. */
  robot_send("F-40 E-80\r");
  f = robot_wait(F);
  if (f > 0) robot_stands(F, f);
  e = robot_wait(E);
  if (e > 0) robot_stands(E, e);
  printf("both are back\n");

  robot_close();
  return 0;
}
