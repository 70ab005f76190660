#!/usr/bin/env bash
# 2. Move and wait: send a joint somewhere, and ask until it has arrived.
#
#     ./2_move_and_wait.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Asks how far there is still to go until nothing is left. Between two questions it does nothing
# for a while. A joint that is blocked would let us ask forever: we give up after so many questions
# with the same answer.
wait_for() {
  local before same=0 # how many answers in a row have been the same
  robot_to_go "$1"
  while [ "$left" -gt 0 ]; do
    echo "  $left counts to go"
    sleep 0.05
    before=$left
    robot_to_go "$1"
    if [ "$left" = "$before" ]; then same=$((same + 1)); else same=0; fi
    if [ "$same" -ge "$stands_after" ]; then
      robot_send "$1X" # forgets the rest of the move
      give_up_standing "$1" "$left"
    fi
  done
  echo "$1 is there"
}

# The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that the
# number ends here. It starts to move, and answers nothing: so we ask.
echo 'E+50'
robot_send 'E+50\r'
wait_for E

# And back again.
echo 'E-50'
robot_send 'E-50\r'
wait_for E
