#!/usr/bin/env bash
# 4. Two joints at once: base and shoulder start together, and the program waits for both.
#
#     ./4_two_joints.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Each joint has its own motor, and the robot does not wait: both start now.
# The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
robot_send 'F+40 E+80\r'
echo 'F+40 E+80'

ask_both() {
  robot_to_go F
  f=$left
  robot_to_go E
  e=$left
}

ask_both
same=0 # number of equal answers in a row, as in example 2
while [ "$f" -gt 0 ] || [ "$e" -gt 0 ]; do
  echo "  F $f, E $e counts to go"
  robot_pause
  before=$((f + e))
  ask_both
  if [ $((f + e)) = "$before" ]; then same=$((same + 1)); else same=0; fi
  if [ "$same" -ge "$stands_after" ]; then
    robot_send 'FX EX' # cancels the rest of the moves
    break
  fi
done
[ "$f" = 0 ] || give_up_standing F "$f"
[ "$e" = 0 ] || give_up_standing E "$e"
echo 'both are there'

# Move back. robot_wait is the loop of example 2, for one joint after the other.
robot_send 'F-40 E-80\r'
robot_wait F
[ "$left" = 0 ] || give_up_standing F "$left"
robot_wait E
[ "$left" = 0 ] || give_up_standing E "$left"
echo 'both are back'
