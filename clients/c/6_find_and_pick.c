/* 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
   down elsewhere, and look again.

       build/6_find_and_pick [HOST [PORT]]

   The arm must be at its soft home, as when the simulator starts or after 3_home. */

#include <math.h>
#include <stdio.h>

#include "robot.h"

#define DEGREES (180 / 3.14159265358979)

/* The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
   of 2 mm. Each byte of the picture has six pixels. */
enum { PIXELS = 192, ROW_BYTES = PIXELS / 6 };

enum { OPEN = -16, SHUT = 64 };     /* counts of the jaws, as in example 5 */
static const double Z = 20;         /* height of the largest block's centre, mm */
static const double ABOVE = 100;    /* height above it for approach and departure, mm */

static const int HOME[JOINTS] = {0};

/* A place on the table: x and y in mm, and the direction of a block's long side in degrees. */
struct place { double x, y, angle; };

/* Sums over the pixels of one patch, to compute its centre and angle. */
struct patch { double n, x, y, xx, yy, xy; };

static char picture[PIXELS][PIXELS]; /* 1 where the camera sees a block */

/* Requests the picture: rows from the top, the leftmost of six pixels in the highest bit, and 32
   added to each byte. */
static void look(void) {
  static unsigned char bytes[PIXELS * ROW_BYTES];
  robot_send("A**");
  robot_read(bytes, sizeof bytes);
  for (int row = 0; row < PIXELS; row++) {
    for (int column = 0; column < PIXELS; column++) {
      int six = bytes[row * ROW_BYTES + column / 6] - 32;
      picture[row][column] = six >> (5 - column % 6) & 1;
    }
  }
}

/* Adds this pixel and all pixels connected to it to the patch and removes them from the picture, so
   that none is counted twice. */
static void collect(int row, int column, struct patch *patch) {
  if (row < 0 || row >= PIXELS || column < 0 || column >= PIXELS) return;
  if (!picture[row][column]) return;
  picture[row][column] = 0;
  double x = 290 - 192 + 2 * (column + 0.5);
  double y = 0 + 192 - 2 * (row + 0.5);
  patch->n += 1;
  patch->x += x;
  patch->y += y;
  patch->xx += x * x;
  patch->yy += y * y;
  patch->xy += x * y;
  collect(row, column + 1, patch);
  collect(row, column - 1, patch);
  collect(row + 1, column, patch);
  collect(row - 1, column, patch);
}

/* The centre of a patch is the average of its pixels. The long side has the direction of their
   largest spread, the principal axis of inertia. */
static struct place measure(const struct patch *patch) {
  double x = patch->x / patch->n, y = patch->y / patch->n;
  double xx = patch->xx / patch->n - x * x;
  double yy = patch->yy / patch->n - y * y;
  double xy = patch->xy / patch->n - x * y;
  double angle = atan2(2 * xy, xx - yy) / 2 * DEGREES;
  struct place place = {x, y, angle < 0 ? angle + 180 : angle};
  return place;
}

static struct place find_largest(void) {
  struct patch largest = {0};
  int patches = 0;
  look();
  for (int row = 0; row < PIXELS; row++) {
    for (int column = 0; column < PIXELS; column++) {
      struct patch patch = {0};
      collect(row, column, &patch);
      if (patch.n > 0) patches++;
      if (patch.n > largest.n) largest = patch;
    }
  }
  printf("blocks in the picture: %d\n", patches);
  if (patches == 0) robot_give_up("the camera sees no block: is one on the table?");
  struct place found = measure(&largest);
  printf("the largest is at x %.0f, y %.0f mm, ", found.x, found.y);
  printf("turned %.0f degrees\n", found.angle);
  return found;
}

/* Inverse kinematics: moves the tool, pointing down, to a place at height z. Seen from the side,
   upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third side leads from the
   shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and 9.5 mm nearer to the
   base. Each motor sets the slope of one link, independently of the others. */
static void go_to(struct place place, double z) {
  double out = hypot(place.x, place.y) - 9.5;
  double up = z + 168.3 - 260.4;
  double base = atan2(place.y, place.x) * DEGREES;
  double slope = atan2(up, out) * DEGREES;
  double corner = acos(hypot(out, up) / 2 / 228.6) * DEGREES;
  double upper_arm = slope + corner, forearm = slope - corner;
  /* A block looks the same after half a turn, so the roll can be reduced to -90...90. */
  double roll = base - place.angle + 90;
  roll -= 180 * round(roll / 180);
  const int wanted[JOINTS] = {[F] = (int)lround(base / 0.2269),
                              [E] = (int)lround((90 - upper_arm) / 0.1135),
                              [D] = (int)lround(forearm / 0.1135),
                              [C] = 0,
                              [B] = (int)lround(roll / 0.3125),
                              [A] = at[A]};
  robot_go(wanted);
}

static void open_jaws(void) {
  const int wanted[JOINTS] = {at[F], at[E], at[D], at[C], at[B], OPEN};
  robot_go(wanted);
}

int main(int argc, char *argv[]) {
  robot_connect(argc, argv);
  struct place block = find_largest();

  open_jaws();
  go_to(block, Z + ABOVE);
  go_to(block, Z);
  robot_send("A+90\r"); /* as in example 5 */
  at[A] += 90 - robot_wait(A);
  if (at[A] >= SHUT) {
    fprintf(stderr, "the jaws closed on nothing: is the block at x %.0f, y %.0f mm? (The examples "
                    "3 to 6 are for the Rhino XR-3 with its own workcell)\n",
            block.x, block.y);
    go_to(block, Z + ABOVE); /* back to the start position */
    robot_go(HOME);
    return 1;
  }
  printf("the jaws closed on %.1f mm\n", 50.8 - 0.79375 * at[A]);
  go_to(block, Z + ABOVE);

  struct place target = {392, 60, 90}; /* a free place, the block's long side along y */
  go_to(target, Z + ABOVE);
  go_to(target, Z);
  open_jaws();
  go_to(target, Z + ABOVE);
  printf("put down at x %.0f, y %.0f mm\n", target.x, target.y);

  find_largest();
  robot_go(HOME);
  printf("back at the start\n");

  robot_close();
  return 0;
}
