/* Loads a robot (URDF or MJCF) into MuJoCo for tests/integration/test_export_judges_release.py.
   mujoco FILE          reads poses from standard input, a line of NAME=VALUE for each, and prints for each
                        the places of all bodies on a line: NAME x y z and the nine elements of the rotation
   mujoco FILE SECONDS  simulates from the key frame `home`; halfway it sets the controls A and B to 0; prints the
                        number of warnings, the largest difference of the joints A and A_2, and the largest
                        distance of a controlled joint from its control at the end */
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static mjtNum *joint(const mjModel *m, mjData *d, const char *name) {
  const int id = mj_name2id(m, mjOBJ_JOINT, name);
  if (id < 0) {
    fprintf(stderr, "no joint %s\n", name);
    exit(1);
  }
  return d->qpos + m->jnt_qposadr[id];
}

static void set_joints(const mjModel *m, mjData *d, char *line) {
  for (char *word = strtok(line, " \n"); word; word = strtok(NULL, " \n")) {
    char *value = strchr(word, '=');
    *value++ = '\0';
    *joint(m, d, word) = atof(value);
  }
}

static void print_bodies(const mjModel *m, const mjData *d) {
  for (int body = 1; body < m->nbody; ++body) {
    printf("%s", mj_id2name(m, mjOBJ_BODY, body));
    for (int i = 0; i < 3; ++i) printf(" %.12g", d->xpos[3 * body + i]);
    for (int i = 0; i < 9; ++i) printf(" %.12g", d->xmat[9 * body + i]);
    printf(body + 1 < m->nbody ? ";" : "\n");
  }
}

static void pose(const mjModel *m, mjData *d) {
  char line[1000];
  while (fgets(line, sizeof line, stdin)) {
    set_joints(m, d, line);
    mj_forward(m, d);
    print_bodies(m, d);
  }
}

static double farthest_from_control(const mjModel *m, const mjData *d) {
  double most = 0;
  for (int i = 0; i < m->nu; ++i)
    most = fmax(most, fabs(d->ctrl[i] - d->qpos[m->jnt_qposadr[m->actuator_trnid[2 * i]]]));
  return most;
}

static void simulate(const mjModel *m, mjData *d, double seconds) {
  double apart = 0;
  int warnings = 0;
  mj_resetDataKeyframe(m, d, mj_name2id(m, mjOBJ_KEY, "home"));
  while (d->time < seconds) {
    if (d->time > seconds / 2)
      d->ctrl[mj_name2id(m, mjOBJ_ACTUATOR, "B")] = d->ctrl[mj_name2id(m, mjOBJ_ACTUATOR, "A")] = 0;
    mj_step(m, d);
    apart = fmax(apart, fabs(*joint(m, d, "A") - *joint(m, d, "A_2")));
  }
  for (int i = 0; i < mjNWARNING; ++i) warnings += d->warning[i].number;
  printf("%d %.9g %.9g\n", warnings, apart, farthest_from_control(m, d));
}

int main(int count, char **arguments) {
  char error[1000] = "";
  mjModel *m = mj_loadXML(arguments[1], NULL, error, sizeof error);
  if (!m) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData *d = mj_makeData(m);
  if (count > 2)
    simulate(m, d, atof(arguments[2]));
  else
    pose(m, d);
  return 0;
}
