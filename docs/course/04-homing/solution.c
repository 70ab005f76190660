/* Exercise 4: find the arm with its microswitches. */

#include "robot.h" /* first: it asks for POSIX */

#include <stdbool.h>

enum { STEP = 10, FAR = 1600 }; /* counts of a move in the search; more counts than any joint has */

/* The count of each switch's near edge, seen from the soft home, and its bit in the reply to an
   inquiry. The jaws are first, because they show how a closed switch reads; the elbow lifts the hand
   off the table. */
static const struct {
  char label;
  int edge;
  const char *inquiry;
  int bit;
} switches[] = {{'A', -16, "J", 16}, {'D', 40, "I", 2},   {'E', -40, "I", 4},
                {'C', 40, "I", 1},   {'B', -25, "J", 32}, {'F', 30, "I", 8}};
enum { SWITCHES = sizeof switches / sizeof switches[0] };

static bool closed; /* what a closed switch reads */

static bool reads(int k) {
  return ((robot_ask(switches[k].inquiry) - ROBOT_SPACE) & switches[k].bit) != 0;
}

static int move_and_wait(char label, int counts) {
  robot_send("%c%+d\r", label, counts);
  return robot_wait(label);
}

/* Moves in steps of these counts until the switch reads `value`. False if the joint stops first. */
static bool creep(int k, int counts, bool value) {
  for (int i = 0; i < FAR / abs(counts); ++i) {
    if (reads(k) == value) return true;
    if (move_and_wait(switches[k].label, counts) > 0) return reads(k) == value;
  }
  return false;
}

/* Brings the joint to the count at which its switch closes on the way from the soft home. */
static void find_edge(int k) {
  const int away = switches[k].edge > 0 ? 1 : -1;
  const bool found = creep(k, STEP * away, closed) || creep(k, -STEP * away, closed);
  if (!found || !creep(k, -STEP * away, !closed) || !creep(k, away, closed))
    robot_give_up("the switch of %c does not change", switches[k].label);
  robot_at[switches[k].label - 'A'] = switches[k].edge;
}

int main(void) {
  robot_connect();

  /* The belts of a cold arm slip: after this nobody knows where it is. */
  const char *joints = "FEDCB";
  for (int k = 0; k < 5; ++k) move_and_wait(joints[k], joints[k] == 'D' ? -60 : 60);

  /* Jaws that are open to their end are on their switch. So that is how a closed switch reads. */
  move_and_wait('A', -100);
  closed = reads(0);

  for (int k = 0; k < SWITCHES; ++k) find_edge(k);
  robot_go("FEDCBA", (int[]){0, 0, 0, 0, 0, 0});
  puts("at the soft home");
  robot_go("FEDCB", (int[]){100, 150, -100, 50, 96});
  robot_close();
  return 0;
}
