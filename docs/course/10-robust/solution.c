/* Exercise 10: sorts three blocks by size, with a robot that loses replies, counts and blocks. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

enum {
  kOpen = -16,      /* count of A */
  kShut = 64,       /* count of A at which the jaws are closed */
  kClosing = 100,   /* counts that close the jaws from any opening */
  kLift = 100,      /* mm */
  kEdge = -40,      /* count at which the switch of E closes */
  kSwitchE = 4,     /* its bit in the reply to I */
  kStep = 5,        /* counts of a quick step in the search for it */
  kTries = 5,       /* of an inquiry */
  kStandsAfter = 6, /* equal replies: the joint stands */
  kRounds = 10      /* then the program gives up */
};
enum { kColumns = 192, kRows = 192, kRowBytes = kColumns / 6, kMm = 2 };
static const double kLeft = 98, kTop = 192; /* edges of the picture, mm */
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

/* Sends an inquiry and reads its reply; asks again if none comes within a second. An inquiry
   changes nothing, so it may be repeated. A move may not. */
static void ask(const char *inquiry, unsigned char *reply, size_t size) {
  for (int i = 0; i < kTries; ++i) {
    robot_send("%s", inquiry);
    size_t done = 0;
    while (done < size) {
      const ssize_t part = recv(robot_line, reply + done, size - done, 0);
      if (part == 0) robot_give_up("the robot has closed the line");
      if (part < 0) break;
      done += (size_t)part;
    }
    if (done == size) return;
    printf("no reply to %s: ask again\n", inquiry);
  }
  robot_give_up("no reply to %s in %d times", inquiry, kTries);
}

static void set_patience(int seconds) {
  const struct timeval timeout = {.tv_sec = seconds};
  setsockopt(robot_line, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
}

static void take_picture(void) {
  static unsigned char reply[kRows * kRowBytes];
  ask("A**", reply, sizeof reply);
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

/* --- Moving: robot_go and robot_wait of robot.h do not ask again. */

/* Waits until a joint has arrived or stands. Returns the counts that were left. */
static int wait_for(char label) {
  const char inquiry[] = {label, '?', '\0'};
  int left = -1;
  for (int same = 0; left != 0 && same < kStandsAfter;) {
    unsigned char reply = 0;
    const int before = left;
    ask(inquiry, &reply, 1);
    left = reply - ROBOT_SPACE;
    same = left == before ? same + 1 : 0;
  }
  if (left > 0) robot_send("%cX", label);
  return left;
}

static void go(const char *labels, const int *counts) {
  int way[8] = {0}, longest = 0;
  for (int k = 0; labels[k]; ++k) {
    way[k] = counts[k] - robot_at[labels[k] - 'A'];
    if (abs(way[k]) > longest) longest = abs(way[k]);
  }
  const int parts = (longest + ROBOT_STRIDE - 1) / ROBOT_STRIDE;
  for (int part = 1; part <= parts; ++part) {
    for (int k = 0; labels[k]; ++k) {
      const int step = way[k] * part / parts - way[k] * (part - 1) / parts;
      if (step != 0) robot_send("%c%+d\r", labels[k], step);
      robot_at[labels[k] - 'A'] += step;
    }
    for (int k = 0; labels[k]; ++k)
      if (wait_for(labels[k]) > 0) robot_give_up("%c has not arrived", labels[k]);
  }
}

static void go_joint(char label, int count) { go((const char[]){label, '\0'}, &count); }

/* The Rhino with the hand pointing down. */
static void go_to(double x, double y, double z, double yaw) {
  const double base = atan2(y, x) * kDegrees;
  const double out = hypot(x, y) - 9.5, up = z + 168.3 - 260.4;
  const double way = atan2(up, out) * kDegrees;
  const double inside = acos(hypot(out, up) / (2 * 228.6)) * kDegrees;
  const double upper = way + inside, forearm = way - inside;
  const double roll = remainder(base - yaw + 90, 180);
  go("FEDCB", (int[]){(int)lround(base / 0.2269), (int)lround((90 - upper) / 0.1135),
                      (int)lround(forearm / 0.1135), 0, (int)lround(roll / 0.3125)});
}

/* --- The shoulder's true place. */

static int is_switch_closed(void) {
  unsigned char reply = 0;
  ask("I", &reply, 1);
  return ((reply - ROBOT_SPACE) & kSwitchE) != 0;
}

/* Finds the edge of E's switch, and so where E really is. */
static void home_shoulder(void) {
  go("FEDCB", (int[5]){0});
  while (is_switch_closed()) go_joint('E', robot_at['E' - 'A'] + kStep);
  while (!is_switch_closed()) go_joint('E', robot_at['E' - 'A'] - kStep);
  while (is_switch_closed()) go_joint('E', robot_at['E' - 'A'] + kStep);
  while (!is_switch_closed()) go_joint('E', robot_at['E' - 'A'] - 1);
  const int drift = kEdge - robot_at['E' - 'A'];
  if (drift != 0) printf("E was wrong by %d counts\n", drift);
  robot_at['E' - 'A'] = kEdge;
}

/* --- Sorting. */

static const double kPlaces[3][2] = {{380, 80}, {380, 0}, {380, -80}}; /* the largest first */
static const double kZ = 15;     /* half the height of all blocks, mm */
static const double kNearMm = 8; /* a block that is so near to its place is there */

/* The blocks in the picture, the largest first. */
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

static void carry(const Block *block, const double place[2]) {
  go_joint('A', kOpen);
  go_to(block->x, block->y, kZ + kLift, block->yaw);
  go_to(block->x, block->y, kZ, block->yaw);
  robot_send("A+%d\r", kClosing);
  robot_at[0] += kClosing - wait_for('A');
  go_to(block->x, block->y, kZ + kLift, block->yaw);
  if (robot_at[0] >= kShut) {
    puts("the jaws closed on nothing");
    return;
  }
  go_to(place[0], place[1], kZ + kLift, 90);
  go_to(place[0], place[1], kZ, 90);
  go_joint('A', kOpen);
  go_to(place[0], place[1], kZ + kLift, 90);
}

int main(void) {
  robot_connect();
  set_patience(1);
  for (int round = 0; round < kRounds; ++round) {
    Block blocks[3];
    home_shoulder();
    find(blocks);
    int k = 0;
    while (k < 3 && hypot(blocks[k].x - kPlaces[k][0], blocks[k].y - kPlaces[k][1]) <= kNearMm) ++k;
    if (k == 3) {
      puts("sorted");
      robot_close();
      return 0;
    }
    carry(&blocks[k], kPlaces[k]);
  }
  robot_give_up("not sorted after %d rounds", kRounds);
}
