#!/usr/bin/env bash
# 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
#
#     ./5_pick_and_place.sh [HOST [PORT]]
#
# The arm must be at its soft home, as when the simulator starts or after 3_home.sh.

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Motor counts from the soft home for each position of the tool. `xr3 kin --pose 262,0,20 --down 90`
# computes those at the block, whose centre is at x 262, y 0 and z 20 mm, with a yaw of 90 degrees.
# "Above" is 100 mm higher. On a real arm one would move there manually and note the counts.
above_block=(F 0 E 242 D -440 C 0 B 0)
at_block=(F 0 E 449 D -625 C 0 B 0)
above_place=(F 0 E 483 D -238 C 0 B 288) # x 400, y 0, not turned
at_place=(F 0 E 623 D -354 C 0 B 288)
home=(F 0 E 0 D 0 C 0 B 0 A 0)
shut=64 # count of A at which the jaws are closed

# robot_go moves all joints to these counts together. A single move is limited to 127 counts, so it
# sends several and waits after each.
robot_go A -16
echo 'the jaws are open'
robot_go "${above_block[@]}"
echo 'above the block'
robot_go "${at_block[@]}"

# Command the jaws to close much further than the block permits. They stop at the block, and the
# remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
# robot_wait also cancels the remaining counts (AX); otherwise the jaws would keep pressing.
robot_send 'A+90\r'
robot_wait A
at[A]=$((at[A] + (90 - left)))
if [ "${at[A]}" -ge "$shut" ]; then
  robot_go "${above_block[@]}" # back to the start position
  robot_go "${home[@]}"
  give_up "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to have \
it there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell)"
fi
# (bash has only integers, so awk computes this.)
awk -v jaws="${at[A]}" 'BEGIN { printf "the jaws closed on %.1f mm\n", 50.8 - 0.79375 * jaws }'

robot_go "${above_block[@]}"
echo 'lifted'
robot_go "${above_place[@]}"
robot_go "${at_place[@]}"
echo 'at its new place'
robot_go A -16
echo 'let go'
robot_go "${above_place[@]}"
robot_go "${home[@]}"
echo 'back at the start'
