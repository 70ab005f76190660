/* 5. Pick and place at known positions: pick up the red block and put it down elsewhere.

       build/5_pick_and_place [HOST [PORT]]

   The arm must be at its soft home, as when the simulator starts or after 3_home. */

#include <stdio.h>

#include "robot.h"

/* The jaws, joint A, are 50.8 mm open at count 0, and a count is 0.79375 mm: 0 mm is count 64. */
enum { OPEN = -16, SHUT = 64 };

/* Motor counts from the soft home for each position of the tool.
   `xr3 kin --pose 262,0,20 --down 90` computes those at the block, whose centre is at x 262, y 0
   and z 20 mm, with a yaw of 90 degrees. "Above" is 100 mm higher. On a real arm one would move
   there manually and note the counts. */
/*                                  F    E     D  C    B */
static const int ABOVE_BLOCK[5] = { 0, 242, -440, 0,   0 };
static const int AT_BLOCK[5] =    { 0, 449, -625, 0,   0 };
static const int ABOVE_PLACE[5] = { 0, 483, -238, 0, 288 }; /* x 400, y 0, not turned */
static const int AT_PLACE[5] =    { 0, 623, -354, 0, 288 };
static const int HOME[JOINTS] =   { 0,   0,    0, 0,   0, 0 };   /* including the jaws, A */

/* Moves the arm there, all joints together, and leaves the jaws as they are. A single move is
   limited to 127 counts, so robot_go sends several and waits after each. */
static void go(const int place[5]) {
  const int wanted[JOINTS] = {place[F], place[E], place[D], place[C], place[B], at[A]};
  robot_go(wanted);
}

static void open_jaws(void) {
  const int wanted[JOINTS] = {at[F], at[E], at[D], at[C], at[B], OPEN};
  robot_go(wanted);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  open_jaws();
  printf("the jaws are open\n");
  go(ABOVE_BLOCK);
  printf("above the block\n");
  go(AT_BLOCK);

  /* Command the jaws to close much further than the block permits. They stop at the block, and the
     remaining counts give its width. robot_wait also cancels the remaining counts (AX); otherwise
     the jaws would keep pressing. */
  robot_send("A+90\r");
  at[A] += 90 - robot_wait(A);
  if (at[A] >= SHUT) {
    fprintf(stderr, "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server "
                    "to have it there (the examples 3 to 6 are for the Rhino XR-3 with its own "
                    "workcell)\n");
    go(ABOVE_BLOCK); /* back to the start position */
    robot_go(HOME);
    return 1;
  }
  printf("the jaws closed on %.1f mm\n", 50.8 - 0.79375 * at[A]);

  go(ABOVE_BLOCK);
  printf("lifted\n");
  go(ABOVE_PLACE);
  go(AT_PLACE);
  printf("at its new place\n");
  open_jaws();
  printf("let go\n");
  go(ABOVE_PLACE);
  robot_go(HOME);
  printf("back at the start\n");

  robot_close();
  return 0;
}
