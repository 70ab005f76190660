#!/usr/bin/env bash
# 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
# down elsewhere, and look again.
#
#     ./6_find_and_pick.sh [HOST [PORT]]
#
# The arm must be at its soft home, as when the simulator starts or after 3_home.sh. Bash has only
# integers, so awk does the trigonometry and the image processing, in counts_at.awk and
# find_largest.awk.

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

z=20        # height of the largest block's centre, mm
above=100   # height above it for approach and departure, mm
jaws_open=-16
jaws_shut=64 # when closed

# The camera's picture is 192 rows of 32 bytes; od prints them as numbers, one row per line. Sets
# $x, $y and $angle to the place of the largest block.
look() {
  local patches
  robot_send 'A**'
  read -r patches x y angle < <(head -c 6144 <&"$from_robot" | od -An -v -tu1 -w32 |
    awk -f find_largest.awk)
  echo "blocks in the picture: $patches"
  [ "$patches" -gt 0 ] || give_up 'the camera sees no block: is one on the table?'
  printf 'the largest is at x %.0f, y %.0f mm, turned %.0f degrees\n' "$x" "$y" "$angle"
}

# go_to X Y ANGLE Z: moves the tool there, pointing down.
go_to() {
  local counts
  read -r -a counts < <(awk -v x="$1" -v y="$2" -v angle="$3" -v z="$4" -f counts_at.awk)
  robot_go "${counts[@]}"
}

look
robot_go A $jaws_open
go_to "$x" "$y" "$angle" $((z + above))
go_to "$x" "$y" "$angle" $z
robot_send 'A+90\r' # as in example 5
robot_wait A
at[A]=$((jaws_open + (90 - left)))
if [ "${at[A]}" -ge $jaws_shut ]; then
  go_to "$x" "$y" "$angle" $((z + above)) # back to the start position
  robot_go F 0 E 0 D 0 C 0 B 0 A 0
  give_up "$(printf 'the jaws closed on nothing: is the block at x %.0f, y %.0f mm?' "$x" "$y") \
(The examples 3 to 6 are for the Rhino XR-3 with its own workcell)"
fi
awk -v jaws="${at[A]}" 'BEGIN { printf "the jaws closed on %.1f mm\n", 50.8 - 0.79375 * jaws }'
go_to "$x" "$y" "$angle" $((z + above))

# A free place, the block's long side along y.
go_to 392 60 90 $((z + above))
go_to 392 60 90 $z
robot_go A $jaws_open
go_to 392 60 90 $((z + above))
echo 'put down at x 392, y 60 mm'

look
robot_go F 0 E 0 D 0 C 0 B 0 A 0
echo 'back at the start'
