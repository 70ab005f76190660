/* 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
   switch that closes at a known position. Searching for it tells where the joint is.

       build/3_home [HOST [PORT]] */

#include <stdio.h>
#include <stdlib.h>

#include "robot.h"

/* Where the switches close, in counts from the soft home: upper arm upright, forearm level, tool
   down. Seen from there each is open before this count, and closed from it on: for a few dozen
   counts on a real arm, for longer in the simulator. */
static const int SWITCHES[JOINTS] = {[F] = 30, [E] = -40, [D] = 40, [C] = 40, [B] = -25, [A] = 16};

/* The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last. */
static const int ORDER[JOINTS] = {D, E, C, B, F, A};

/* One byte reports several switches: I those of joints C to F, J those of A and B. Each has one
   bit. */
static const int BITS[JOINTS] = {[F] = 8, [E] = 4, [D] = 2, [C] = 1, [B] = 2, [A] = 1};

enum {
  STEP = 10,    /* counts of one move of the search; a switch stays closed for longer */
  WIDEST = 100, /* more counts than a switch of a real arm stays closed */
  FAR = 1600,   /* more counts than any joint has from a limit to its switch */
  UNKNOWN = -1
};

/* How far to search away from the soft home before trying the other direction. The shoulder must
   not lean far back, or the hand hits the base. */
static const int REACH[JOINTS] = {[F] = FAR, [E] = 60, [D] = FAR, [C] = FAR, [B] = FAR, [A] = FAR};

/* What a closed switch reads, 0 or 1: not known until the first one has changed. */
static int closed = UNKNOWN;

/* The bit of the joint's switch. Some controllers report a closed switch as 1, others as 0. */
static int read_switch(int joint) {
  int reply = robot_ask(joint == A || joint == B ? "J" : "I");
  return (reply - 32) & BITS[joint] ? 1 : 0;
}

/* Moves the joint and returns the counts that were left, 0 if it has arrived. */
static int step(int joint, int counts) {
  robot_send("%c%+d\r", LETTERS[joint], counts);
  return robot_wait(joint); /* as in example 2; cancels the move of a blocked joint */
}

/* Moves in steps of `counts` until the switch changes. Returns 0 if it does not within `farthest`
   counts, or before the joint is blocked. */
static int changes(int joint, int counts, int farthest) {
  int before = read_switch(joint);
  for (int gone = 0; gone < farthest; gone += abs(counts)) {
    int left = step(joint, counts);
    if (read_switch(joint) != before) return 1;
    if (left > 0) return 0;
  }
  return 0;
}

/* Moves to the count at which the switch closes. Returns 0 if the switch does not change. */
static int find_near_edge(int joint, int away) {
  /* Watch the switch change, at whichever edge: first in one direction, then in the other. If it
     reads like the closed ones before, the near edge lies towards the soft home. */
  int is_closed = read_switch(joint) == closed;
  int way = is_closed ? -away : away;
  int reach = is_closed ? FAR : REACH[joint];
  if (!changes(joint, STEP * way, reach) && !changes(joint, -STEP * way, 2 * FAR) &&
      !changes(joint, STEP * way, 2 * FAR)) {
    return 0;
  }

  /* Move towards the soft home until the switch has not changed for a long way: now it is open. */
  while (changes(joint, -STEP * away, WIDEST)) {
  }

  /* Quickly up to the near edge, back again, and then count by count. */
  return changes(joint, STEP * away, FAR) && changes(joint, -STEP * away, FAR) &&
         changes(joint, away, FAR);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  for (int k = 0; k < JOINTS; k++) {
    int joint = ORDER[k];
    if (!find_near_edge(joint, SWITCHES[joint] > 0 ? 1 : -1)) {
      robot_give_up("the switch of %c does not change. Is the joint blocked at a limit, or the arm "
                    "stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 "
                    "with its own workcell)", LETTERS[joint]);
    }
    closed = read_switch(joint);
    printf("%c is on its switch, at %+d\n", LETTERS[joint], SWITCHES[joint]);
  }

  /* All switches at once. J also reports four input lines, in its bits 4 to 32. */
  int i = robot_ask("I") - 32;
  int j = (robot_ask("J") - 32) & 3;
  printf("a closed switch reads %d; the switches of I are %d, those of J %d\n", closed, i, j);

  /* The soft home is at count 0: move each joint back by the count of its switch. */
  for (int k = 0; k < JOINTS; k++) {
    int left = step(ORDER[k], -SWITCHES[ORDER[k]]);
    if (left > 0) robot_stands(ORDER[k], left);
  }
  printf("at the soft home\n");

  robot_close();
  return 0;
}
