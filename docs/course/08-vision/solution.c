/* Exercise 8: finds the block with the largest area in the picture, and points above it. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

enum { kColumns = 192, kRows = 192, kRowBytes = kColumns / 6, kMm = 2 };
static const double kLeft = 98, kTop = 192; /* edges of the picture, mm */
static const double kHeight = 100;          /* of the tip above the table, mm */
static const double kDegrees = 57.29577951308232;

static unsigned char image[kRows]
                          [kColumns]; /* 1 where a block is, 0 elsewhere and where it is counted */

/* Sums over the pixels of a patch. */
typedef struct {
  double n, x, y, xx, yy, xy;
} Sums;

typedef struct {
  double area, x, y, yaw;
} Block;

static void take_picture(void) {
  static unsigned char reply[kRows * kRowBytes];
  robot_send("A**");
  robot_read(reply, sizeof reply);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      image[row][column] =
          (unsigned char)((reply[row * kRowBytes + column / 6] - 32) >> (5 - column % 6) & 1);
}

/* Adds the patch that a pixel belongs to, and clears it. */
static void add_patch(int first_column, int first_row, Sums *sums) {
  static int stack[kRows * kColumns];
  int size = 0;
  stack[size++] = first_row * kColumns + first_column;
  image[first_row][first_column] = 0;
  while (size > 0) {
    const int pixel = stack[--size], column = pixel % kColumns, row = pixel / kColumns;
    const double x = kLeft + kMm * (column + 0.5), y = kTop - kMm * (row + 0.5);
    sums->n += 1, sums->x += x, sums->y += y;
    sums->xx += x * x, sums->yy += y * y, sums->xy += x * y;
    const int sides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int k = 0; k < 4; ++k) {
      const int c = column + sides[k][0], r = row + sides[k][1];
      if (c < 0 || c >= kColumns || r < 0 || r >= kRows || !image[r][c]) continue;
      image[r][c] = 0;
      stack[size++] = r * kColumns + c;
    }
  }
}

static Block measured(const Sums *sums) {
  const double n = sums->n, x = sums->x / n, y = sums->y / n;
  const double m20 = sums->xx - n * x * x, m02 = sums->yy - n * y * y, m11 = sums->xy - n * x * y;
  return (Block){n * kMm * kMm, x, y, atan2(2 * m11, m20 - m02) / 2 * kDegrees};
}

static Block largest(void) {
  Block best = {0};
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      if (!image[row][column]) continue;
      Sums sums = {0};
      add_patch(column, row, &sums);
      const Block block = measured(&sums);
      printf("area %.0f mm2, x %.1f, y %.1f mm, yaw %.1f\n", block.area, block.x, block.y,
             block.yaw);
      if (block.area > best.area) best = block;
    }
  if (best.area == 0) robot_give_up("the camera sees no block");
  return best;
}

/* The Rhino with the hand pointing down: exercise 6, in the vertical plane of the arm. */
static void go_to(double x, double y, double z, double yaw) {
  const double base = atan2(y, x) * kDegrees;
  const double out = hypot(x, y) - 9.5, up = z + 168.3 - 260.4;
  const double way = atan2(up, out) * kDegrees;
  const double inside = acos(hypot(out, up) / (2 * 228.6)) * kDegrees;
  const double upper = way + inside, forearm = way - inside;
  const double roll =
      remainder(base - yaw + 90, 180); /* a block looks the same after half a turn */
  robot_go("FEDCB", (int[]){(int)lround(base / 0.2269), (int)lround((90 - upper) / 0.1135),
                            (int)lround(forearm / 0.1135), 0, (int)lround(roll / 0.3125)});
}

int main(void) {
  robot_connect();
  take_picture();
  const Block block = largest();
  go_to(block.x, block.y, kHeight, block.yaw);
  robot_close();
  return 0;
}
