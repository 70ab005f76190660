/* Exercise 2: forward kinematics by link matrices, and a search with them. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

typedef struct {
  double at[4][4];
} Matrix;

static double radians(double degrees) { return degrees * acos(-1.0) / 180; }

/* The link matrix of one row of the Denavit-Hartenberg table: degrees and mm. */
static Matrix link_matrix(double theta, double d, double a, double alpha) {
  const double ct = cos(radians(theta)), st = sin(radians(theta));
  const double ca = cos(radians(alpha)), sa = sin(radians(alpha));
  return (Matrix){{{ct, -ca * st, sa * st, a * ct},
                   {st, ca * ct, -sa * ct, a * st},
                   {0, sa, ca, d},
                   {0, 0, 0, 1}}};
}

static Matrix product(Matrix left, Matrix right) {
  Matrix result = {{{0}}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) result.at[i][j] += left.at[i][k] * right.at[k][j];
  return result;
}

/* The tool frame at the motor counts of F, E, D, C, B: the links from the base to the tool. */
static Matrix tool(const int counts[5]) {
  const double f = counts[0], e = counts[1], d = counts[2], c = counts[3], b = counts[4];
  Matrix result = link_matrix(0.2269 * f, 260.4, 0, -90);
  result = product(result, link_matrix(-90 + 0.1135 * e, 0, 228.6, 0));
  result = product(result, link_matrix(90 - 0.1135 * (d + e), 0, 228.6, 0));
  result = product(result, link_matrix(0.1135 * (d - c), 0, 9.5, -90));
  return product(result, link_matrix(-90 + 0.3125 * b, 168.3, 0, 0));
}

int main(void) {
  const double height = 250; /* mm */
  /* Angles to counts: subtract the home value, divide by the degrees of a count, round. */
  int counts[5] = {(int)lround(30 / 0.2269), (int)lround((-70 + 90) / 0.1135), -220, 0,
                   (int)lround((-60 + 90) / 0.3125)};
  /* A larger C turns the hand outwards. Of all C, the one whose tip is nearest to the height. */
  int best = 0;
  double best_off = 1e9;
  for (counts[3] = 0; counts[3] < 500; ++counts[3]) {
    const double off = fabs(tool(counts).at[2][3] - height);
    if (off < best_off) {
      best_off = off;
      best = counts[3];
    }
  }
  counts[3] = best;
  const Matrix end = tool(counts);
  printf("C%+d, tip %.1f %.1f %.1f\n", best, end.at[0][3], end.at[1][3], end.at[2][3]);

  robot_connect();
  robot_go("FEDCB", counts);
  robot_close();
  return 0;
}
