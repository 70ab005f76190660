/* Turns the base of an exported Rhino in MuJoCo by half a radian, and prints the place of the tool. */
#include <mujoco/mujoco.h>
#include <stdio.h>

int main(int count, char **arguments) {
  char error[1000] = "turn FILE.xml";
  mjModel *model = count == 2 ? mj_loadXML(arguments[1], NULL, error, sizeof error) : NULL;
  if (!model) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData *data = mj_makeData(model);
  mj_resetDataKeyframe(model, data, mj_name2id(model, mjOBJ_KEY, "home"));
  data->ctrl[mj_name2id(model, mjOBJ_ACTUATOR, "F")] = 0.5;
  while (data->time < 2) mj_step(model, data);
  const mjtNum *tool = data->xpos + 3 * mj_name2id(model, mjOBJ_BODY, "tool");
  printf("tool at %.3f %.3f %.3f m\n", tool[0], tool[1], tool[2]);
  mj_deleteData(data);
  mj_deleteModel(model);
  return 0;
}
