#!/usr/bin/env bash
# 2. Move and wait: move a joint and ask until it has arrived.
#
#     ./2_move_and_wait.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Asks for the remaining counts until none are left, with a pause between two questions. A blocked
# joint would never finish, so the program gives up after a number of equal answers.
wait_for() {
  local before same=0 # number of equal answers in a row
  robot_to_go "$1"
  while [ "$left" -gt 0 ]; do
    echo "  $left counts to go"
    robot_pause
    before=$left
    robot_to_go "$1"
    if [ "$left" = "$before" ]; then same=$((same + 1)); else same=0; fi
    if [ "$same" -ge "$stands_after" ]; then
      robot_send "$1X" # cancels the rest of the move
      give_up_standing "$1" "$left"
    fi
  done
  echo "$1 is there"
}

# Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
# starts to move and does not answer, so the program has to ask.
echo 'E+50'
robot_send 'E+50\r'
wait_for E

# Move back.
echo 'E-50'
robot_send 'E-50\r'
wait_for E
