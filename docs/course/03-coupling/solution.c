/* Exercise 3: three motors that each turn one link in space, whatever the others do. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

static const double precision = 0.1135; /* degrees a count, of E, D and C */
static int at[3];                       /* E, D, C */

static int counts_of(double degrees) { return (int)lround(degrees / precision); }

/* Adds counts to the motors, moves, and prints the joint angles that follow. */
static void step(int e, int d, int c) {
  at[0] += e;
  at[1] += d;
  at[2] += c;
  robot_go("EDC", at);
  printf("E%+d D%+d C%+d: theta2 %.2f, theta3 %.2f, theta4 %.2f\n", at[0], at[1], at[2],
         -90 + precision * at[0], 90 - precision * (at[1] + at[0]), precision * (at[1] - at[2]));
}

int main(void) {
  robot_connect();
  /* Each motor sets the direction of its own link: forward is E+, up is D+, outwards is C+. */
  step(counts_of(20), counts_of(-20), counts_of(30));
  /* The belts keep forearm and hand as they are. */
  step(counts_of(15), 0, 0);
  /* As one piece: theta3 and theta4 stay, so D goes against E, and C with D. */
  step(counts_of(-10), -counts_of(-10), -counts_of(-10));
  robot_close();
  return 0;
}
