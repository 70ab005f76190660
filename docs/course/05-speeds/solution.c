/* Exercise 5: two joints of the Adept One that arrive together: the tip moves along a line. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

enum {
  SHOULDER = 470, /* counts of E and D: the tip at x 500, y 0 */
  ELBOW = 1029,
  FASTEST = 220, /* counts a second, at most 255 */
  LONGEST = 110  /* counts of a move, at most 127 */
};

/* The counts of one part of a way that is cut into equal parts. */
static int part_of(int way, int part, int parts) {
  return way * part / parts - way * (part - 1) / parts;
}

int main(void) {
  robot_connect();

  /* Speeds as the distances: then both joints need the same time, and always are at the same part
     of their way. */
  const int slower = (int)lround((double)FASTEST * SHOULDER / ELBOW);
  printf("E: %d counts at %d counts a second, D: %d at %d\n", SHOULDER, slower, ELBOW, FASTEST);
  robot_send("E%dSD%dS", slower, FASTEST);

  /* The counters have 8 bits. After each part both joints are on the line again. */
  const int parts = (ELBOW + LONGEST - 1) / LONGEST;
  for (int part = 1; part <= parts; ++part) {
    robot_send("E%+d\rD%+d\r", part_of(SHOULDER, part, parts), part_of(ELBOW, part, parts));
    if (robot_wait('E') > 0 || robot_wait('D') > 0) robot_give_up("a joint stands");
  }
  robot_close();
  return 0;
}
