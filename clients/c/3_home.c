/* 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
   switch that closes at a known position. Searching for it tells where the joint is.

       build/3_home [HOST [PORT]] */

#include <stdio.h>
#include <stdlib.h>

#include "robot.h"

/* Counts at which the switches close, from the soft home: upper arm upright, forearm level, tool
   down. Seen from there each is open before this count, and closed from it on: for a few dozen
   counts on a real arm, for longer in the simulator. */
static const int SWITCHES[JOINTS] = {[F] = 30, [E] = -40, [D] = 40, [C] = 40, [B] = -25, [A] = -16};

/* The jaws, joint A, come first: they show how a closed switch reads. The elbow follows, since it
   lifts the hand off the table. */
static const int ORDER[JOINTS] = {A, D, E, C, B, F};

/* One byte reports several switches: I those of joints C to F, J those of A and B. Each has one
   bit. */
static const int BITS[JOINTS] = {[F] = 8, [E] = 4, [D] = 2, [C] = 1, [B] = 32, [A] = 16};

enum {
  STEP = 10,  /* counts of one move of the search; a switch stays closed for longer */
  FAR = 1600, /* more counts than any joint has from a limit to its switch */
  LEAN = 400  /* counts forward that bring the shoulder out of its backmost position */
};

/* What a closed switch reads, 0 or 1. */
static int closed;

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

/* Moves until the switch closes, usually away from the soft home first. Returns 0 if it does not
   close. */
static int search(int joint, int away) {
  /* Forwards first: a shoulder that leans back folds the arm into its base. */
  if (joint == E) return changes(E, STEP, LEAN) || changes(E, -STEP, 2 * FAR);

  if (changes(joint, STEP * away, FAR)) return 1;
  /* The shoulder may lean far back: it must not when the forearm comes down. */
  if (joint == D) changes(E, STEP, LEAN);
  return changes(joint, -STEP * away, 2 * FAR);
}

/* Moves to the count at which the switch closes. Returns 0 if the switch does not change. */
static int find_near_edge(int joint) {
  int away = SWITCHES[joint] > 0 ? 1 : -1;
  if (read_switch(joint) != closed && !search(joint, away)) return 0;
  /* Back until the switch opens, and then count by count until it closes. */
  return changes(joint, -STEP * away, FAR) && changes(joint, away, FAR);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);

  /* The open jaws are at the end of their travel, and on their switch. It opens when they close. */
  changes(A, -STEP, FAR);
  closed = read_switch(A);

  /* A shoulder on its switch may lean far back: it comes forward before the forearm moves. */
  if (read_switch(E) == closed) find_near_edge(E);

  for (int k = 0; k < JOINTS; k++) {
    int joint = ORDER[k];
    if (!find_near_edge(joint)) {
      robot_give_up("the switch of %c does not change. Is the joint blocked at a limit, or the arm "
                    "stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 "
                    "with its own workcell)", LETTERS[joint]);
    }
    printf("%c is on its switch, at %+d\n", LETTERS[joint], SWITCHES[joint]);
  }

  /* All switches at once. J also reports four input lines, in its bits 1 to 8. */
  int i = robot_ask("I") - 32;
  int j = (robot_ask("J") - 32) & 48;
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
