/* Exercise 1: connect, ask, move the shoulder twice, and wait each time. */

#include "robot.h"

static void move_and_wait(int counts) {
  printf("E%+d\n", counts);
  robot_send("E%+d\r", counts);
  const int left = robot_wait('E');
  if (left > 0) robot_give_up("E stands, %d counts short of its target", left);
}

int main(void) {
  robot_connect();
  printf("hello, robot: E has %d counts to go\n", robot_to_go('E'));
  move_and_wait(50);
  move_and_wait(90);
  puts("E is there");
  robot_close();
  return 0;
}
