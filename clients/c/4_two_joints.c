/* 4. Two joints at once: base and shoulder start together, and the program waits for both.

       build/4_two_joints [HOST [PORT]] */

#include <stdio.h>

#include "robot.h"

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* Each joint has its own motor, and the robot does not wait: both start now.
     The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move. */
  robot_send("F+40 E+80\r");
  printf("F+40 E+80\n");

  int f = robot_to_go(F), e = robot_to_go(E);
  int same = 0; /* number of equal answers in a row, as in example 2 */
  while (f > 0 || e > 0) {
    printf("  F %d, E %d counts to go\n", f, e);
    robot_pause();
    int before = f + e;
    f = robot_to_go(F);
    e = robot_to_go(E);
    same = f + e == before ? same + 1 : 0;
    if (same == STANDS_AFTER) {
      robot_send("FX EX"); /* cancel the rest: the next move would add to it */
      if (f > 0) robot_stands(F, f);
      if (e > 0) robot_stands(E, e);
    }
  }
  printf("both are there\n");

  /* Move back. robot_wait is the loop of example 2, for one joint after the other. */
  robot_send("F-40 E-80\r");
  f = robot_wait(F);
  if (f > 0) robot_stands(F, f);
  e = robot_wait(E);
  if (e > 0) robot_stands(E, e);
  printf("both are back\n");

  robot_close();
  return 0;
}
