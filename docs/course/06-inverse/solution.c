/* Exercise 6: three points with the Adept One; the inverse kinematics is computed here. */

#include "robot.h" /* first: it asks for POSIX */

#include <math.h>

static const double kA1 = 425, kA2 = 375;    /* lengths of the two links, mm */
static const double kTop = 877, kHand = 200; /* height of the arm, from the slide to the tip, mm */
static const double kDegrees = 57.29577951308232; /* of a radian */
static const int kOpen = -40;                     /* count of A at which the jaws are wide open */

/* The same direction, from -180 to 180 degrees. */
static double near(double angle) { return remainder(angle, 360); }

/* Moves the tip there with this elbow, +1 or -1. Returns 0 if a joint would be past its limit. */
static int try_elbow(double x, double y, double z, double yaw, int elbow) {
  const double cosine = (x * x + y * y - kA1 * kA1 - kA2 * kA2) / (2 * kA1 * kA2);
  if (fabs(cosine) > 1) robot_give_up("x %g, y %g mm is out of reach", x, y);
  const double bend = elbow * acos(cosine);
  const double first = atan2(y, x) - atan2(kA2 * sin(bend), kA1 + kA2 * cos(bend));
  const double theta1 = near(first * kDegrees);
  const double theta2 = -bend * kDegrees; /* frame 2 hangs upside down: hence the minus */
  if (fabs(theta1) > 150 || fabs(theta2) > 147) return 0;
  const double d3 = kTop - kHand - z;
  const double theta4 = near(theta1 - theta2 - yaw);
  const int counts[] = {(int)lround(theta1 / 0.1), (int)lround(theta2 / 0.1),
                        (int)lround((d3 - 100) / 0.5), (int)lround((theta4 - 90) / 0.3125)};
  printf("x %g, y %g, z %g: E %d, D %d, C %d, B %d\n", x, y, z, counts[0], counts[1], counts[2],
         counts[3]);
  robot_go("EDCB", counts);
  return 1;
}

static void go_to(double x, double y, double z, double yaw) {
  if (!try_elbow(x, y, z, yaw, -1) && !try_elbow(x, y, z, yaw, 1))
    robot_give_up("x %g, y %g mm: both elbows are past a limit", x, y);
}

/* Closes the jaws until they stand at the pin. */
static void close_jaws(void) {
  robot_send("A+100\r");
  robot_at[0] += 100 - robot_wait('A');
}

int main(void) {
  robot_connect();
  robot_go("A", &kOpen);
  go_to(500, 300, 620, 0);
  go_to(500, 300, 520, 0); /* point 1 */
  close_jaws();
  go_to(500, 300, 620, 0);
  go_to(300, -450, 620, 0);
  go_to(300, -450, 520, 0); /* point 2 */
  robot_go("A", &kOpen);
  go_to(300, -450, 620, 0);
  go_to(-420, -300, 650, 0); /* point 3 */
  robot_close();
  return 0;
}
