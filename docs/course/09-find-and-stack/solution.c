/* Exercise 9: finds three blocks with the camera, and stacks them: green on red, blue on green. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

enum { kColumns = 192, kRows = 192, kRowBytes = kColumns / 6 };
enum { kOpen = -40, kClosing = 100, kLift = 100 };
static const double kMm = 2.5;               /* of a pixel */
static const double kLeft = 160, kTop = 240; /* edges of the picture, mm */
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

/* Red, green and blue: the areas tell them apart, red has the largest. */
static void find(Block blocks[3]) {
  int found = 0;
  take_picture();
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      if (!image[row][column]) continue;
      Sums sums = {0};
      add_patch(column, row, &sums);
      if (found == 3) robot_give_up("there are more than three patches in the picture");
      int at = found++;
      const Block block = measured(&sums);
      for (; at > 0 && blocks[at - 1].area < block.area; --at) blocks[at] = blocks[at - 1];
      blocks[at] = block;
    }
  if (found != 3) robot_give_up("the picture has %d patches, not 3", found);
}

/* The Intelledex with the hand pointing down: two links in the plane of the arm. F stays. */
static void go_to(double x, double y, double z, double yaw) {
  const double base = atan2(y, x) * kDegrees;
  const double out = hypot(x, y), up = z + 228.6 - 373.4;
  const double way = atan2(up, out) * kDegrees;
  const double inside = acos(hypot(out, up) / (2 * 304.8)) * kDegrees;
  const double upper = way + inside, forearm = way - inside;
  const double roll = remainder(base - yaw, 180); /* a block looks the same after half a turn */
  robot_go("GEDCB", (int[]){(int)lround(base / 0.1), (int)lround(upper / 0.1),
                            (int)lround((forearm - upper) / 0.1),
                            (int)lround((-forearm - 90) / 0.1), (int)lround(roll / 0.3125)});
}

static void move_jaws(int count) { robot_go("A", &count); }

/* Closes the jaws until they stand; robot_wait clears the rest with AX. */
static void close_jaws(void) {
  robot_send("A+%d\r", kClosing);
  const int left = robot_wait('A');
  robot_at[0] += kClosing - left;
  if (left == 0) robot_give_up("the jaws closed on nothing");
}

/* Picks up a block from the table, and puts it down with its underside at `floor` mm. */
static void carry(const Block *block, double height, const Block *goal, double floor) {
  const double half = height / 2;
  move_jaws(kOpen);
  go_to(block->x, block->y, half + kLift, block->yaw);
  go_to(block->x, block->y, half, block->yaw);
  close_jaws();
  go_to(block->x, block->y, half + kLift, block->yaw);
  go_to(goal->x, goal->y, floor + half + kLift, goal->yaw);
  go_to(goal->x, goal->y, floor + half, goal->yaw);
  move_jaws(kOpen);
  go_to(goal->x, goal->y, floor + half + kLift, goal->yaw);
}

int main(void) {
  Block blocks[3];
  robot_connect();
  find(blocks);
  carry(&blocks[1], 30, &blocks[0], 40);      /* green on red */
  carry(&blocks[2], 24, &blocks[0], 40 + 30); /* blue on green */
  robot_close();
  return 0;
}
