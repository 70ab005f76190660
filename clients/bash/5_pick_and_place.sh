#!/usr/bin/env bash
# 5. Pick and place at known positions: take the red block from where it lies, and put it somewhere
# else.
#
#     ./5_pick_and_place.sh [HOST [PORT]]
#
# The arm has to be at its soft home, as it is when the simulator starts, or after 3_home.sh.

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Where the motors have to be, in counts from the soft home, for the tool to be at a place. `xr3
# kin --pose 262,0,20 --down 90` works out the one of the block: its middle is at x 262, y 0 and z
# 20 mm, and it is turned by 90 degrees. "Above" is 100 mm higher up. On a real arm one would
# drive there by hand and write the counts down.
above_block=(F 0 E 242 D -440 C 0 B 0)
at_block=(F 0 E 449 D -625 C 0 B 0)
above_place=(F 0 E 483 D -238 C 0 B 288) # x 400, y 0, not turned
at_place=(F 0 E 623 D -354 C 0 B 288)
home=(F 0 E 0 D 0 C 0 B 0 A 0)
shut=-64 # where the jaws, A, have nothing between them

# robot_go brings all joints to these counts together. A single move is at most 127 counts long,
# so it sends several, and waits after each.
robot_go A 16
echo 'the jaws are open'
robot_go "${above_block[@]}"
echo 'above the block'
robot_go "${at_block[@]}"

# Close the jaws much further than the block lets them. They stop at the block, and what is left
# to go tells how wide it is: A is 50.8 mm open at count 0, and a count is 0.79375 mm. robot_wait
# also clears what is left (AX), or the jaws would go on pressing.
robot_send 'A-100\r'
robot_wait A
at[A]=$((at[A] - (100 - left)))
if [ "${at[A]}" -le "$shut" ]; then
  robot_go "${above_block[@]}" # back to where the examples begin
  robot_go "${home[@]}"
  give_up "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to have it \
there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell, in the profile paper)"
fi
# (bash reckons in whole numbers: awk does the rest.)
awk -v jaws="${at[A]}" 'BEGIN { printf "the jaws closed on %.1f mm\n", 50.8 + 0.79375 * jaws }'

robot_go "${above_block[@]}"
echo 'lifted'
robot_go "${above_place[@]}"
robot_go "${at_place[@]}"
echo 'at its new place'
robot_go A 16
echo 'let go'
robot_go "${above_place[@]}"
robot_go "${home[@]}"
echo 'back at the start'
